#include <algorithm>
#include <numeric>

#include "mesh/model/point_tree.h"
#include "mesh/repair/conform.h"

namespace raytube {

namespace {

std::vector<std::uint32_t> all_vertices(std::size_t count) {
  std::vector<std::uint32_t> members(count);
  std::iota(members.begin(), members.end(), 0u);
  return members;
}

std::vector<std::uint32_t> border_vertices(const EdgeTable& edges) {
  std::vector<std::uint32_t> members;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].sides.size() == 1) members.insert(members.end(), {edges[e].low, edges[e].high});
  std::ranges::sort(members);
  members.erase(std::unique(members.begin(), members.end()), members.end());
  return members;
}

/// Puts the vertices found on an edge in their order from its lower end.
EdgeSplit split_at(std::span<const dvec3> vertices, const EdgeTable::Edge& edge, std::vector<std::uint32_t> found) {
  const dvec3 along = vertices[edge.high] - vertices[edge.low];
  std::ranges::sort(found, {}, [&](std::uint32_t v) { return std::pair(glm::dot(vertices[v], along), v); });
  return {edge.low, edge.high, std::move(found)};
}

/// Of a triangle at the edge; the edge's own ends are.
bool is_corner(std::uint32_t vertex, const EdgeTable::Edge& edge, std::span<const Triangle> triangles) {
  return std::ranges::any_of(edge.sides,
                             [&](const EdgeTable::Side& side) { return has_corner(triangles[side.triangle], vertex); });
}

}  // namespace

std::vector<EdgeSplit> find_t_junctions(std::span<const dvec3> vertices, std::span<const Triangle> triangles,
                                        const EdgeTable& edges, double distance) {
  std::vector<EdgeSplit> splits;
  std::vector<std::uint32_t> border = border_vertices(edges);
  if (border.empty()) return splits;
  const PointTree border_tree(vertices, std::move(border)), full_tree(vertices, all_vertices(vertices.size()));
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeTable::Edge edge = edges[e];
    const PointTree& tree = edge.sides.size() == 1 ? full_tree : border_tree;
    std::vector<std::uint32_t> found;
    tree.near_segment(vertices[edge.low], vertices[edge.high], distance, found);
    std::erase_if(found, [&](std::uint32_t v) { return is_corner(v, edge, triangles); });
    if (!found.empty()) splits.push_back(split_at(vertices, edge, std::move(found)));
  }
  return splits;
}

}  // namespace raytube
