// Splitting edges at vertices that lie on them, in every triangle that has the edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/repair/facets.h"

namespace raytube {

/// The edge between the vertices low and high is to become the path low, vertices..., high.
struct EdgeSplit {
  std::uint32_t low, high;
  std::vector<std::uint32_t> vertices;
};

struct SplitCount {
  std::uint64_t added = 0;     // triangles
  std::uint64_t vanished = 0;  // triangles of which nothing is left but pieces with repeated corners
};

/// Cuts the triangles along the splits, of which there is one for an edge at most; pieces are made of what the triangle was.
/// `splits` gets sorted.
SplitCount apply_splits(std::vector<EdgeSplit>& splits, Facets& facets);

}  // namespace raytube
