// Makes the mesh conforming: no vertex lies on the inside of an edge, and no triangle is flat.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/edge_table.h"
#include "mesh/model/geometry.h"
#include "mesh/model/triangle_mesh.h"
#include "mesh/repair/edge_splits.h"

namespace raytube {

/// Splits edges at the vertices on them until there are none, and drops triangles without area; returns the edges of what is
/// left. Fills triangles_added, triangles_degenerate and t_junctions_split of the report.
EdgeTable make_conforming(std::span<const dvec3> vertices, Facets& facets, double distance, MeshReport& report);

/// T-junctions: a vertex within `distance` of a border edge, or a border vertex of any edge. Unless such an edge is split,
/// there is a crack, and a false half plane on both its sides. A vertex of a triangle at the edge makes that a sliver instead.
std::vector<EdgeSplit> find_t_junctions(std::span<const dvec3> vertices, std::span<const Triangle> triangles,
                                        const EdgeTable& edges, double distance);

struct SliverRemoval {
  std::vector<std::uint32_t> triangles;  // to be dropped, ascending
  std::vector<EdgeSplit> splits;         // so that their neighbours close up behind them
};

/// Triangles of less height than `distance`, each with the split of its longest edge at the vertex opposite. Slivers behind
/// one another go together. A sliver stays if without it things were no better.
SliverRemoval find_slivers(std::span<const dvec3> vertices, std::span<const Triangle> triangles, const EdgeTable& edges,
                           double distance);

}  // namespace raytube
