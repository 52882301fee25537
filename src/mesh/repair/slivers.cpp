#include <algorithm>

#include "mesh/repair/conform.h"

namespace raytube {

namespace {

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

/// A sliver goes away by splitting its longest edge at its apex. Slivers behind its short edges go with it, all at once.
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

}  // namespace

SliverRemoval find_slivers(std::span<const dvec3> vertices, std::span<const Triangle> triangles, const EdgeTable& edges,
                           double distance) {
  return SliverFinder(vertices, triangles, edges, distance).removal();
}

}  // namespace raytube
