#include "mesh/conform.h"

#include <algorithm>

namespace raytube {

namespace {

/// True if something was split.
bool split(std::vector<EdgeSplit> splits, std::vector<Triangle>& triangles, MeshReport& report) {
  if (splits.empty()) return false;
  for (const EdgeSplit& s : splits) report.t_junctions_split += s.vertices.size();
  const SplitCount count = apply_splits(splits, triangles);
  report.triangles_added += count.added;
  report.triangles_degenerate += count.vanished;
  return true;
}

/// A few rounds settle every mesh seen so far; the cap is there because nothing proves it.
constexpr int max_rounds = 64;

}  // namespace

void make_conforming(std::span<const dvec3> vertices, std::vector<Triangle>& triangles, double distance, MeshReport& report) {
  for (int round = 0; round < max_rounds; ++round) {
    const EdgeTable edges(triangles, vertices.size());
    // Slivers first: on their long edges lie the vertices of others, which would all be taken for T-junctions.
    if (split(find_sliver_splits(vertices, triangles, edges, distance), triangles, report)) continue;
    if (!split(find_t_junctions(vertices, triangles, edges, distance), triangles, report)) break;
  }
  report.triangles_degenerate += std::erase_if(triangles, [&](const Triangle& t) { return height(vertices, t) == 0.0; });
}

}  // namespace raytube
