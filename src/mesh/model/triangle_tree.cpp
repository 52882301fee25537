#include "mesh/model/triangle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

constexpr std::uint32_t triangles_per_leaf = 4;

// Along a direction that is far from the given one.
dvec3 across(const dvec3& direction) {
  const dvec3 size = glm::abs(direction);
  const dvec3 other = size.x <= size.y && size.x <= size.z ? dvec3(1, 0, 0) : size.y <= size.z ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
  return glm::normalize(glm::cross(direction, other));
}

const dvec3& farthest(std::span<const dvec3> points, const dvec3& from) {
  return *std::ranges::max_element(points, {}, [&](const dvec3& p) { return glm::dot(p - from, p - from); });
}

bool have_one_in_common(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  return std::ranges::any_of(a, [&](std::uint32_t v) { return v != no_index && std::ranges::find(b, v) != b.end(); });
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh), members_(mesh.triangles.size()) {
  std::iota(members_.begin(), members_.end(), 0u);
  std::vector<dvec3> points;
  if (!members_.empty()) build(0, static_cast<std::uint32_t>(members_.size()), points);
}

// The first axis between two points far apart, the second towards the one farthest from their line: triangles, fans and strips
// lie flat in it.
TriangleTree::TurnedBox TriangleTree::box_round(std::span<const dvec3> points) {
  TurnedBox box;
  const dvec3 from = farthest(points, points[0]), longest = farthest(points, from) - from;
  if (glm::length(longest) > 0.0) {
    const dvec3 along = glm::normalize(longest);
    const auto aside = [&](const dvec3& p) { return p - from - glm::dot(p - from, along) * along; };
    const dvec3 widest = aside(*std::ranges::max_element(points, {}, [&](const dvec3& p) { return glm::length(aside(p)); }));
    const dvec3 rest = widest - glm::dot(widest, along) * along;
    const dvec3 second = glm::length(rest) > 0.0 ? glm::normalize(rest) : across(along);
    box.axes = {along, second, glm::cross(along, second)};
  }
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const dvec3& p : points) {
      low = std::min(low, glm::dot(box.axes[axis], p - from));
      high = std::max(high, glm::dot(box.axes[axis], p - from));
    }
    box.middle += 0.5 * (low + high) * box.axes[axis];
    box.half[axis] = 0.5 * (high - low);
  }
  box.middle += from;
  return box;
}

TriangleTree::Node TriangleTree::node_of(std::uint32_t begin, std::uint32_t end, std::vector<dvec3>& points) const {
  Node node{{}, begin, end, 0, mesh_.triangle_patch[members_[begin]], mesh_.triangles[members_[begin]]};
  points.clear();
  for (std::uint32_t i = begin; i < end; ++i) {
    const Triangle& t = mesh_.triangles[members_[i]];
    for (const std::uint32_t v : t) points.push_back(mesh_.vertices[v]);
    for (std::uint32_t& v : node.common)
      if (std::ranges::find(t, v) == t.end()) v = no_index;
    if (mesh_.triangle_patch[members_[i]] != node.patch) node.patch = no_index;
  }
  node.box = box_round(points);
  return node;
}

dvec3 TriangleTree::sum_of_corners(std::uint32_t triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c];
}

// The axis along which the triangles' middles lie farthest apart; their corners may do so along another one.
dvec3 TriangleTree::spread(const Node& node) const {
  Box middles;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const dvec3 sum = sum_of_corners(members_[i]);
    middles.add({glm::dot(node.box.axes[0], sum), glm::dot(node.box.axes[1], sum), glm::dot(node.box.axes[2], sum)});
  }
  const dvec3 size = middles.high - middles.low;
  return node.box.axes[size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2];
}

void TriangleTree::build(std::uint32_t begin, std::uint32_t end, std::vector<dvec3>& points) {
  const std::size_t index = nodes_.size();
  nodes_.push_back(node_of(begin, end, points));
  if (end - begin <= triangles_per_leaf) return;
  const dvec3 along = spread(nodes_[index]);
  const auto depth = [&](std::uint32_t t) { return std::pair(glm::dot(along, sum_of_corners(t)), t); };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::ranges::nth_element(members_.begin() + begin, members_.begin() + middle, members_.begin() + end, {}, depth);
  build(begin, middle, points);
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end, points);
}

// Gottschalk, Lin, Manocha (1996): the normals of both boxes and the products of their edges tell. A product shorter than one
// understates the gap, which is safe.
bool TriangleTree::are_apart(const TurnedBox& a, const TurnedBox& b, double distance) {
  const dvec3 between = b.middle - a.middle;
  if (glm::length(between) > glm::length(a.half) + glm::length(b.half) + distance) return true;
  const auto separates = [&](const dvec3& axis) {
    double reach = distance;
    for (int i = 0; i < 3; ++i)
      reach += a.half[i] * std::abs(glm::dot(a.axes[i], axis)) + b.half[i] * std::abs(glm::dot(b.axes[i], axis));
    return std::abs(glm::dot(between, axis)) > reach;
  };
  if (std::ranges::any_of(a.axes, separates) || std::ranges::any_of(b.axes, separates)) return true;
  for (const dvec3& edge_a : a.axes)
    for (const dvec3& edge_b : b.axes)
      if (separates(glm::cross(edge_a, edge_b))) return true;
  return false;
}

// The tree against itself: two nodes apart, of one patch or round one vertex need no closer look. Large nodes in tasks of their
// own, each with its own pairs.
class TriangleTree::Join {
 public:
  using Accept = std::function<bool(std::uint32_t, std::uint32_t)>;

  Join(const TriangleTree& tree, double distance, const Accept& accept) : tree_(tree), distance_(distance), accept_(accept) {}

  void within(std::uint32_t at, Pairs& pairs) const {
    const Node& node = tree_.nodes_[at];
    if (are_settled(node, node)) return;
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        for (std::uint32_t j = i + 1; j < node.end; ++j) look_at(tree_.members_[i], tree_.members_[j], pairs);
    } else if (node.end - node.begin < least_task) {
      within(at + 1, pairs);
      within(node.right, pairs);
      between(at + 1, node.right, pairs);
    } else {
      Pairs right, across;
      tbb::parallel_invoke([&] { within(at + 1, pairs); }, [&] { within(node.right, right); },
                           [&] { between(at + 1, node.right, across); });
      pairs.insert(pairs.end(), right.begin(), right.end());
      pairs.insert(pairs.end(), across.begin(), across.end());
    }
  }

 private:
  static constexpr std::uint32_t least_task = 4096;

  static bool are_settled(const Node& a, const Node& b) {
    return (a.patch != no_index && a.patch == b.patch) || have_one_in_common(a.common, b.common);
  }

  void between(std::uint32_t at_a, std::uint32_t at_b, Pairs& pairs) const {
    const Node &a = tree_.nodes_[at_a], &b = tree_.nodes_[at_b];
    if (are_settled(a, b) || are_apart(a.box, b.box, distance_)) return;
    if (a.right == 0 && b.right == 0) {
      for (std::uint32_t i = a.begin; i < a.end; ++i)
        for (std::uint32_t j = b.begin; j < b.end; ++j) look_at(tree_.members_[i], tree_.members_[j], pairs);
    } else if (b.right == 0 || (a.right != 0 && glm::length(a.box.half) >= glm::length(b.box.half))) {
      between(at_a + 1, at_b, pairs);
      between(a.right, at_b, pairs);
    } else {
      between(at_a, at_b + 1, pairs);
      between(at_a, b.right, pairs);
    }
  }

  void look_at(std::uint32_t t, std::uint32_t u, Pairs& pairs) const {
    const TriangleMesh& mesh = tree_.mesh_;
    if (mesh.triangle_patch[t] != mesh.triangle_patch[u] && !have_one_in_common(mesh.triangles[t], mesh.triangles[u]) &&
        accept_(t, u))
      pairs.emplace_back(t, u);
  }

  const TriangleTree& tree_;
  double distance_;
  const Accept& accept_;
};

TriangleTree::Pairs TriangleTree::close_pairs(double distance, const Join::Accept& accept) const {
  Pairs pairs;
  if (!nodes_.empty()) Join(*this, distance, accept).within(0, pairs);
  return pairs;
}

void TriangleTree::near_line(const dvec3& origin, const dvec3& direction, std::vector<std::uint32_t>& found) const {
  found.clear();
  // A dozen roundings of numbers up to the radius and the origin's distance, and as much again.
  const double rounding = 32.0 * std::numeric_limits<double>::epsilon() * (mesh_.radius + glm::length(origin));
  const auto passes_by = [&](const TurnedBox& box) {
    dvec3 from, along;
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = glm::dot(box.axes[axis], origin - box.middle);
      along[axis] = glm::dot(box.axes[axis], direction);
    }
    const dvec3 moment = glm::abs(glm::cross(from, along)), size = glm::abs(along), &half = box.half;
    return moment.x > half.y * size.z + half.z * size.y + rounding || moment.y > half.z * size.x + half.x * size.z + rounding ||
           moment.z > half.x * size.y + half.y * size.x + rounding;
  };
  std::vector<std::uint32_t> waiting;
  if (!nodes_.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const std::uint32_t at = waiting.back();
    waiting.pop_back();
    const Node& node = nodes_[at];
    if (passes_by(node.box)) continue;
    if (node.right == 0) {
      found.insert(found.end(), members_.begin() + node.begin, members_.begin() + node.end);
    } else {
      waiting.push_back(node.right);
      waiting.push_back(at + 1);
    }
  }
}

}  // namespace raytube
