// The target as the solver takes it: welded, oriented triangles grouped in planar patches and connected components.
//
// mesh/model holds what all of mesh/ works on: the mesh and its report, polygons as read, tables of edges, trees of points,
// triangles and faces. Recentred coordinates: metres, origin in the middle of the target's bounding box. Indices are of 32 bits,
// no_index stands for none.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/field.h"
#include "mesh/model/edge_table.h"
#include "mesh/model/geometry.h"
#include "mesh/model/made_once.h"
#include "mesh/model/triangle_rows.h"

namespace raytube {

/// Stands for no triangle, no patch, no material.
inline constexpr std::uint32_t no_index = 0xffffffffu;

/// Connected coplanar triangles of one material; the plane is normal . r = offset, in recentred coordinates [m].
struct Patch {
  dvec3 normal;                       // unit; outward on closed components
  double offset;                      // of the plane [m]
  std::uint32_t material = no_index;  // among those of the sweep; no_index: a perfect conductor

  /// Height of a point over the plane [m].
  double height(const dvec3& point) const { return glm::dot(normal, point) - offset; }
  /// Distance from a point to the plane along a direction [m].
  double distance(const dvec3& point, const dvec3& direction) const {
    return (offset - glm::dot(normal, point)) / glm::dot(normal, direction);
  }
};

/// Triangles connected through shared edges after welding.
struct Component {
  bool closed = false;          // bounds a volume that waves do not enter: only the outer side is exposed
  std::uint32_t triangles = 0;  // how many
  bool penetrable = false;      // bounds a volume, but waves enter it: both sides are exposed
};

/// A crease as steep as an edge between facets that stand for one smooth surface all the same.
struct Bend {
  std::uint32_t low, high;  // vertices
  double angle;             // between the facets' normals [rad]
};

/// Vertices are in metres relative to `center`, the middle of the target's bounding box in the mesh's own coordinates.
/// Winding is counter-clockwise seen from outside for closed components, and for those that bound a volume which waves enter;
/// consistent within open ones.
struct TriangleMesh {
  std::vector<dvec3> vertices;                          // recentred coordinates [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of vertices
  std::vector<std::uint32_t> triangle_patch;            // [triangle]
  std::vector<std::uint32_t> triangle_component;        // [triangle]
  std::vector<Patch> patches;                           // numbered as triangle_patch says
  std::vector<Component> components;                    // numbered as triangle_component says
  std::vector<std::uint32_t> triangle_part;             // [triangle] among part_names; empty: nobody wanted it
  std::vector<std::string> part_names;                  // by the names in the mesh file, or of it
  std::vector<Bend> bends;                              // in order of (low, high); none until somebody looks (find_bends)
  dvec3 center{0.0};                                    // in the mesh's own coordinates [m]
  double radius = 0.0;                                  // largest distance of a vertex from `center`
  double coordinate_step = 0.0;                         // by which its file rounds coordinates [m]

  /// Its edges. Like the rows below they are made when they are first asked for, once; triangles stay as they are from then on.
  const EdgeTable& edges() const {
    return edges_.get([&] { return EdgeTable(triangles, vertices.size()); });
  }
  /// The triangles at each vertex, in ascending order.
  const TriangleRows& at_vertex() const {
    return at_vertex_.get([&] { return triangle_rows(vertices.size(), triangles, std::identity()); });
  }
  /// The triangles of each patch, in ascending order.
  const TriangleRows& of_patch() const {
    return of_patch_.get([&] { return triangle_rows(patches.size(), triangle_patch); });
  }

  /// Whether two triangles of one patch, and no others, meet at an edge.
  bool is_inside_patch(const EdgeTable::Edge& edge) const {
    return edge.sides.size() == 2 && triangle_patch[edge.sides[0].triangle] == triangle_patch[edge.sides[1].triangle];
  }
  /// Whether one surface goes on across an edge: of two triangles that run along it in opposite senses.
  bool is_surface(const EdgeTable::Edge& edge) const {
    return edge.sides.size() == 2 && !is_turned(edge.sides[0], edge.sides[1]);
  }
  /// Whether two sides of an edge run along it in the same sense: the fronts of their triangles are on different sides.
  bool is_turned(const EdgeTable::Side& a, const EdgeTable::Side& b) const {
    return triangles[a.triangle][a.corner] == triangles[b.triangle][b.corner];
  }

  /// The corners of a triangle as points.
  std::array<dvec3, 3> corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {vertices[a], vertices[b], vertices[c]};
  }
  /// Twice the area of a triangle [m^2].
  double twice_area(std::uint32_t triangle) const { return glm::length(area_vector(vertices, triangles[triangle])); }
  /// The patch that a triangle is part of.
  const Patch& patch_of(std::uint32_t triangle) const { return patches[triangle_patch[triangle]]; }
  /// Whether a triangle is part of a closed component.
  bool closed(std::uint32_t triangle) const { return components[triangle_component[triangle]].closed; }
  /// Whether the edge between two vertices is among the bends.
  bool is_bend(std::uint32_t a, std::uint32_t b) const {
    const auto ends = [](const Bend& bend) { return std::pair(bend.low, bend.high); };
    return std::ranges::binary_search(bends, std::pair(std::min(a, b), std::max(a, b)), {}, ends);
  }

 private:
  MadeOnce<EdgeTable> edges_;
  MadeOnce<TriangleRows> at_vertex_, of_patch_;
};

/// One line of the mesh report: what was found or mended, and how many facets, vertices or edges it concerned.
struct MeshNote {
  std::string what;         // in words
  std::uint64_t count = 0;  // facets, vertices or edges
};

/// Every facet read is traced or listed here:
/// triangles_read + triangles_added = triangles_traced + triangles_degenerate + triangles_duplicate + triangles_internal.
struct MeshReport {
  std::uint64_t facets_read = 0;      // polygons in the file
  std::uint64_t vertices_read = 0;    // before welding
  std::uint64_t facets_unusable = 0;  // polygons with fewer than three distinct corners
  std::uint64_t free_forms_read = 0;  // curves and surfaces given by formulas: left out
  std::uint64_t triangles_read = 0;   // after splitting polygons into triangles
  std::uint64_t vertices_welded = 0;  // merged into another vertex

  // As they stand in the file, vertices welded but nothing mended; facets without area not counted.
  std::uint64_t open_edges_read = 0;          // one facet only
  std::uint64_t non_manifold_edges_read = 0;  // more than two facets meet
  std::uint64_t badly_wound_edges_read = 0;   // its two facets run along it in the same sense

  std::uint64_t triangles_degenerate = 0;          // dropped: no area
  std::uint64_t triangles_duplicate = 0;           // dropped: same corners as another one
  std::uint64_t duplicates_of_other_material = 0;  // of these: made of something else than the one that stays
  std::uint64_t triangles_internal = 0;            // dropped: coincident opposite facets where two closed bodies touch
  std::uint64_t t_junctions_split = 0;             // vertices on the inside of an edge, those of flat facets too
  std::uint64_t triangles_added = 0;               // by these splits
  std::uint64_t triangles_flipped = 0;             // winding reversed for consistent, outward orientation

  // As traced.
  std::uint64_t triangles_traced = 0;                // of the mesh that comes out
  std::uint64_t open_edges = 0;                      // one triangle only
  std::uint64_t non_manifold_edges = 0;              // more than two triangles meet
  std::uint64_t components = 0;                      // connected through edges
  std::uint64_t components_closed = 0;               // no wave enters them
  std::uint64_t components_penetrable = 0;           // closed, but waves go through part of them: not among components_closed
  std::uint64_t components_nearly_closed = 0;        // open, but for a gap small against their area
  std::uint64_t patches = 0;                         // connected and coplanar
  double weld_distance = 0.0;                        // [m]
  double coordinate_step = 0.0;                      // between neighbouring coordinates, as the files round them [m]
  std::vector<std::filesystem::path> further_files;  // read beside the mesh files, which name them
  std::vector<std::string> remarks;                  // as those of the polygons (PolygonSoup)

  /// Readable lines, only those with something to say.
  std::vector<MeshNote> notes() const;
};

}  // namespace raytube
