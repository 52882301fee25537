// Splitting edges at vertices that lie on them, in every triangle that has the edge.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/repair/facets.h"

namespace raytube {

/// The edge between the vertices low and high is to become the path low, vertices..., high.
struct EdgeSplit {
  std::uint32_t low, high;
  std::vector<std::uint32_t> vertices;
  std::pair<std::uint32_t, std::uint32_t> ends() const { return {low, high}; }
};

/// Cuts the triangles along the splits, of which there is one for an edge at most; pieces are made of what the triangle was, and
/// those with repeated corners vanish. Fills t_junctions_split, triangles_added and triangles_degenerate of the report.
void apply_splits(std::vector<EdgeSplit> splits, Facets& facets, MeshReport& report);

}  // namespace raytube
