// How triangles lie to one another and to a point.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/model/face_tree.h"

namespace raytube {

/// The corners of a triangle.
using Corners = std::array<dvec3, 3>;

/// Whether a plane with a gap of this width [m] on it separates the two (Gottschalk, Lin and Manocha 1996: for convex polyhedra
/// it is enough to try the normals of both and the products of their edges; for flat ones also the normals of edges in their
/// planes).
bool are_apart(const Corners& a, const Corners& b, double distance);

/// True if both lie in one plane, to within `distance` [m], and cover one another there by more than that.
bool lie_upon_one_another(const Corners& a, const Corners& b, double distance);

/// Solid angle of a triangle as the origin sees it, above zero if it runs counter-clockwise there (van Oosterom & Strackee 1983,
/// IEEE Trans. BME-30, 125) [sr].
double solid_angle(const Corners& corners);

/// Fills `found` with the faces whose boxes reach into this one.
void collect_within(const FaceTree& faces, const Box& box, std::vector<std::uint32_t>& found);

/// Fills `found` with the faces whose boxes reach into that of a triangle, widened by `margin` [m].
void collect_near(const FaceTree& faces, const Corners& corners, double margin, std::vector<std::uint32_t>& found);

/// How often these triangles wind about a point: those of a closed component wound outward once if it is inside, and never
/// outside; else something between.
double winding_number(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const dvec3& point);

}  // namespace raytube
