#include "mesh/repair/conform.h"

#include <algorithm>

namespace raytube {

namespace {

bool remove_slivers(std::span<const dvec3> vertices, const EdgeTable& edges, Facets& facets, double distance,
                    MeshReport& report) {
  SliverRemoval removal = find_slivers(vertices, facets.triangles, edges, distance);
  if (removal.triangles.empty()) return false;
  report.triangles_degenerate += facets.drop_if([&](std::size_t i) { return std::ranges::binary_search(removal.triangles, i); });
  apply_splits(std::move(removal.splits), facets, report);
  return true;
}

bool split_t_junctions(std::span<const dvec3> vertices, const EdgeTable& edges, Facets& facets, double distance,
                       MeshReport& report) {
  std::vector<EdgeSplit> splits = find_t_junctions(vertices, facets.triangles, edges, distance);
  if (splits.empty()) return false;
  apply_splits(std::move(splits), facets, report);
  return true;
}

/// A few rounds settle every mesh seen so far; the cap is there because nothing proves it.
constexpr int max_rounds = 64;

}  // namespace

EdgeTable make_conforming(std::span<const dvec3> vertices, Facets& facets, double distance, MeshReport& report) {
  EdgeTable edges(facets.triangles, vertices.size());
  const auto find_edges_again = [&] { edges = EdgeTable(facets.triangles, vertices.size()); };
  for (int round = 0; round < max_rounds; ++round, find_edges_again())
    // Slivers first: on their long edges lie the vertices of others, which would all be taken for T-junctions.
    if (!remove_slivers(vertices, edges, facets, distance, report) &&
        !split_t_junctions(vertices, edges, facets, distance, report))
      break;
  const std::size_t flat = facets.drop_if([&](std::size_t i) { return height(vertices, facets.triangles[i]) == 0.0; });
  report.triangles_degenerate += flat;
  if (flat > 0) find_edges_again();
  return edges;
}

}  // namespace raytube
