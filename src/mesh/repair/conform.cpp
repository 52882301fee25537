#include <algorithm>
#include <numeric>

#include "mesh/model/point_tree.h"
#include "mesh/repair/edge_splits.h"
#include "mesh/repair/steps.h"

namespace raytube {

namespace {

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

/// T-junctions: a vertex within `distance` of a border edge, or a border vertex of any edge. Unless such an edge is split,
/// there is a crack, and a false half plane on both its sides. A vertex of a triangle at the edge makes that a sliver instead.
std::vector<EdgeSplit> find_t_junctions(std::span<const dvec3> vertices, std::span<const Triangle> triangles,
                                        const EdgeTable& edges, double distance) {
  std::vector<EdgeSplit> splits;
  std::vector<std::uint32_t> border = border_vertices(edges);
  if (border.empty()) return splits;
  std::vector<std::uint32_t> all(vertices.size());
  std::iota(all.begin(), all.end(), 0u);
  const PointTree border_tree(vertices, std::move(border)), full_tree(vertices, std::move(all));
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

struct SliverRemoval {
  std::vector<std::uint32_t> triangles;  // to be dropped, ascending
  std::vector<EdgeSplit> splits;         // so that their neighbours close up behind them
};

/// A flat triangle, its longest edge and the vertex opposite to that edge.
struct Sliver {
  std::uint32_t triangle;
  std::uint32_t edge;
  std::uint32_t apex;
  double length;  // of the edge
  double height;
  bool removed = false;
};

std::vector<Sliver> collect(std::span<const dvec3> vertices, std::span<const Triangle> triangles, const EdgeTable& edges,
                            double distance) {
  std::vector<Sliver> slivers;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const double h = height(vertices, triangles[i]);
    if (h > distance) continue;
    const int k = longest_edge(vertices, triangles[i]);
    const std::uint32_t edge = edges.edge_of(i, k);
    const double length = glm::distance(vertices[edges[edge].low], vertices[edges[edge].high]);
    slivers.push_back({i, edge, triangles[i][(k + 2) % 3], length, h});
  }
  // Behind a short edge lies a sliver with a shorter longest edge: in this order each comes after those behind it.
  std::ranges::sort(slivers, {}, [](const Sliver& s) { return std::pair(s.length, s.triangle); });
  return slivers;
}

/// Triangles of less height than `distance`. A sliver goes away by splitting its longest edge at its apex. Slivers behind its
/// short edges go with it, all at once; it stays if without it things were no better.
class SliverFinder {
 public:
  SliverFinder(std::span<const dvec3> vertices, std::span<const Triangle> triangles, const EdgeTable& edges, double distance)
      : vertices_(vertices), triangles_(triangles), edges_(edges), slivers_(collect(vertices, triangles, edges, distance)) {
    for (std::size_t i = 0; i < slivers_.size(); ++i) {
      by_triangle_.emplace_back(slivers_[i].triangle, i);
      by_edge_.emplace_back(slivers_[i].edge, i);
    }
    std::ranges::sort(by_triangle_);
    std::ranges::sort(by_edge_);
  }

  SliverRemoval removal() {
    for (std::size_t i = slivers_.size(); i-- > 0;) slivers_[i].removed = can_go(i);
    SliverRemoval result;
    for (const Sliver& s : slivers_) {
      if (!s.removed) continue;
      result.triangles.push_back(s.triangle);
      result.splits.push_back({edges_[s.edge].low, edges_[s.edge].high, path_round(s)});
    }
    std::ranges::sort(result.triangles);
    return result;
  }

 private:
  using Index = std::vector<std::pair<std::uint32_t, std::size_t>>;

  static std::size_t look_up(const Index& index, std::uint32_t key) {
    const auto found = std::ranges::lower_bound(index, std::pair(key, std::size_t{0}));
    return found != index.end() && found->first == key ? found->second : no_sliver;
  }

  /// Decided from long to short, so that a sliver knows whether the one in front of it goes.
  bool can_go(std::size_t i) const {
    const Sliver& s = slivers_[i];
    if (look_up(by_edge_, s.edge) != i) return false;  // one sliver an edge
    for (const auto& [triangle, corner] : edges_[s.edge].sides) {
      if (triangle == s.triangle) continue;
      const std::size_t front = look_up(by_triangle_, triangle);
      if (front != no_sliver && front < i && slivers_[front].edge != s.edge) return false;  // as long as this one: not decided
      const bool leaves_too = front != no_sliver && (slivers_[front].removed || slivers_[front].edge == s.edge);
      if (!leaves_too && !gets_better(s, triangles_[triangle], static_cast<int>(corner))) return false;
    }
    return true;
  }

  /// Both pieces of the neighbour must be higher than the sliver. Without this, four vertices almost but not quite on a line
  /// pass a sliver to and fro for ever.
  bool gets_better(const Sliver& s, const Triangle& neighbour, int corner) const {
    const std::uint32_t a = neighbour[corner], b = neighbour[(corner + 1) % 3], c = neighbour[(corner + 2) % 3];
    return c == s.apex || std::min(height(vertices_, {a, s.apex, c}), height(vertices_, {s.apex, b, c})) > s.height;
  }

  /// The way round the sliver and those behind it, from the lower to the higher end of its longest edge.
  std::vector<std::uint32_t> path_round(const Sliver& s) const {
    std::vector<std::uint32_t> path = path_behind(edges_[s.edge].low, s.apex);
    path.push_back(s.apex);
    const std::vector<std::uint32_t> second = path_behind(s.apex, edges_[s.edge].high);
    path.insert(path.end(), second.begin(), second.end());
    return path;
  }

  std::vector<std::uint32_t> path_behind(std::uint32_t from, std::uint32_t to) const {
    const std::size_t edge = edges_.find(std::min(from, to), std::max(from, to));
    const std::size_t behind = look_up(by_edge_, static_cast<std::uint32_t>(edge));
    if (behind == no_sliver || !slivers_[behind].removed) return {};
    std::vector<std::uint32_t> path = path_round(slivers_[behind]);
    if (from > to) std::ranges::reverse(path);
    return path;
  }

  static constexpr std::size_t no_sliver = ~std::size_t{0};

  std::span<const dvec3> vertices_;
  std::span<const Triangle> triangles_;
  const EdgeTable& edges_;
  std::vector<Sliver> slivers_;
  Index by_triangle_, by_edge_;
};

bool remove_slivers(std::span<const dvec3> vertices, const EdgeTable& edges, Facets& facets, double distance,
                    MeshReport& report) {
  SliverRemoval removal = SliverFinder(vertices, facets.triangles, edges, distance).removal();
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
