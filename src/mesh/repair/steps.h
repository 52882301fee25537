// The steps of build_mesh, in their order. `distance` is that of welding unless something else is said.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/model/edge_table.h"
#include "mesh/model/geometry.h"
#include "mesh/model/triangle_mesh.h"
#include "mesh/repair/facets.h"

namespace raytube {

struct WeldedPoints {
  std::vector<dvec3> vertices;
  std::vector<std::uint32_t> vertex_of_point;
};

/// Vertices that lie together become one. Taken in order, each point joins the first kept vertex within `distance` of it, or is
/// kept as a new vertex where it is; so the vertices are more than `distance` apart. `diagonal` is that of the points' bounding
/// box; all in one unit.
WeldedPoints weld(std::span<const dvec3> points, double distance, double diagonal);

/// Makes the mesh conforming: no vertex lies on the inside of an edge, and no triangle is flat. Splits edges at the vertices on
/// them until there are none, and drops triangles without area; returns the edges of what is left. Fills triangles_added,
/// triangles_degenerate and t_junctions_split of the report.
EdgeTable make_conforming(std::span<const dvec3> vertices, Facets& facets, double distance, MeshReport& report);

/// Gives coincident faces the same triangles, so that they are doubles of one another triangle by triangle: surfaces drawn from
/// both sides whose copies have other diagonals or are subdivided otherwise, and walls between bodies that touch. A face is a set
/// of triangles in one plane around which others meet or the plane ends; two coincide if their outlines do. Polygons that are
/// somewhat warped count as well, if they have the same corners. Faces that overlap in part stay as they are, and so does a
/// surface that runs back along itself, as both walls of a closed slit.
/// `edges` are those of the facets. Fills triangles_added and t_junctions_split of the report.
void align_coincident_faces(std::span<const dvec3> vertices, const EdgeTable& edges, double distance, Facets& facets,
                            MeshReport& report);

/// Keeps one of several triangles with the same corners and winding. Triangles with the same corners and opposite windings
/// are either the wall where two closed bodies touch, and both go, or an open surface drawn from both sides, and one stays. A
/// wall that waves reach through what is around it is no such wall. The first one stays, whatever the others are made of. Fills
/// triangles_duplicate, duplicates_of_other_material and triangles_internal of the report.
void drop_duplicates(Facets& facets, std::span<const Material> materials, std::size_t vertex_count, MeshReport& report);

struct Surfaces {
  std::vector<std::uint32_t> triangle_component;
  std::vector<Component> components;  // in order of their first triangles
};

/// Winds the triangles of each component alike: closed components outward, open ones as most of their triangles were.
/// Components end where more than two triangles meet at an edge, so that a fin on a box is one of its own, unless pieces make
/// a closed body together. A component is closed if its borders cancel in opposite pairs and it is thicker than `distance`.
/// Fills triangles_flipped and components_nearly_closed of the report.
Surfaces orient(std::span<const dvec3> vertices, std::vector<Triangle>& triangles, double distance, MeshReport& report);

/// Groups triangles that are connected within a component and lie in one plane within `distance`; fills `patches` and
/// `triangle_patch` of the mesh. Vertices that are off the planes of their patches by no more than the file's rounding are put
/// on them, where they would lie without it: so edges lie in faces, and faces of several triangles are plane. `materials` of each
/// triangle, or empty if all are perfect conductors, cut the patches found so: pieces keep their plane, so that the shape of a
/// target does not depend on what it is made of.
void find_patches(TriangleMesh& mesh, double distance, std::span<const std::uint32_t> materials = {});

}  // namespace raytube
