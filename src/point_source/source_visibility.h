// What a point source, or a plane wave, reaches before anything else: exact, by cutting triangles with the shadows of all others.
#pragma once

#include <optional>

#include "mesh/model/triangle_mesh.h"
#include "point_source/spatial_polygon.h"

namespace raytube {

/// Where rays come from: a point, or a plane from which they all leave along its normal.
struct Eye {
  dvec3 place;  // the point, or any point of the plane
  std::optional<dvec3> direction;
  dvec3 ray_at(const dvec3& r) const { return direction ? *direction : r - place; }
};

/// The half spaces whose common part holds all rays of the eye through a convex polygon.
struct Shadow {
  std::vector<HalfSpace> sides;
  bool misses(std::span<const dvec3> corners, double tolerance) const;
};

/// Nothing if the eye sees the polygon edge-on.
std::optional<Shadow> shadow(const Eye& eye, const SpatialPolygon& polygon, double tolerance);

/// The part of a polygon inside a shadow, empty if there is none.
SpatialPolygon clipped(SpatialPolygon polygon, const Shadow& shadow, double tolerance);

struct Segment {
  dvec3 from, to;
};

struct VisiblePiece {
  std::uint32_t triangle;
  SpatialPolygon outline;
  std::vector<Segment> border;  // the edges of the outline, without what another piece of the same plane goes on from
};

/// What lies closer than this to a plane lies on it [m]: far above rounding, far below what a ray model resolves.
double cut_tolerance(const TriangleMesh& mesh, const Eye& eye);

/// Convex pieces of triangles that the eye sees, in the order of the triangles. Both sides of a triangle count; where two
/// coincide, one is seen (here the lower one, by a ray either). The work grows with the square of the number of triangles.
std::vector<VisiblePiece> visible_pieces(const TriangleMesh& mesh, const Eye& eye);

/// Fills the borders of all pieces.
void find_borders(const TriangleMesh& mesh, double tolerance, std::vector<VisiblePiece>& pieces);

}  // namespace raytube
