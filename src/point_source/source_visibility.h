// Source visibility: what a point source, or a plane wave, reaches before anything else. Exact, by cutting triangles with the
// shadows of all others.
//
// Recentred coordinates [m]; shares are of 1.
#pragma once

#include <optional>

#include "mesh/model/triangle_mesh.h"
#include "point_source/spatial_polygon.h"

namespace raytube {

/// Where rays come from: a point, or a plane from which they all leave along its normal, `direction`.
struct Eye {
  dvec3 position;  // the point, or any point of the plane
  std::optional<dvec3> direction;
  /// The direction of the ray that reaches r, not of unit length where it comes from a point.
  dvec3 ray_at(const dvec3& r) const { return direction ? *direction : r - position; }
};

/// The half spaces whose common part holds all rays of the eye through a convex polygon.
struct Shadow {
  std::vector<HalfSpace> sides;
  /// True if a convex polygon of these corners lies outside one of the sides, or within `tolerance` [m] of it.
  bool misses(std::span<const dvec3> corners, double tolerance) const;
};

/// The shadow of a convex polygon; nothing if the eye sees it edge-on, to within `tolerance` [m].
std::optional<Shadow> shadow(const Eye& eye, const SpatialPolygon& polygon, double tolerance);

/// The part of a polygon inside a shadow, empty if there is none.
SpatialPolygon clipped(SpatialPolygon polygon, const Shadow& shadow, double tolerance);

struct Segment {
  dvec3 from, to;
};

struct VisiblePiece {
  std::uint32_t triangle;
  SpatialPolygon outline;
  std::vector<Segment> border;  // the edges of the outline, without what is an edge of another piece of the same plane too
};

/// What lies closer than this to a plane lies on it [m]: far above rounding, far below what a ray model resolves.
double cut_tolerance(const TriangleMesh& mesh, const Eye& eye);

/// Convex pieces of triangles that the eye sees, in the order of the triangles. Both sides of a triangle count; where two
/// coincide, one is visible (here the lower one, to a ray either). The work grows with the square of the number of triangles.
std::vector<VisiblePiece> visible_pieces(const TriangleMesh& mesh, const Eye& eye);

/// Fills the borders of all pieces; edges closer than `tolerance` [m] lie on one another.
void find_borders(const TriangleMesh& mesh, double tolerance, std::vector<VisiblePiece>& pieces);

}  // namespace raytube
