#include "mesh/model/triangle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

constexpr std::uint32_t triangles_per_leaf = 4;
constexpr double slender_ratio = 16.0;  // of the square of the longest side to twice the area; 1.2 of an equilateral triangle

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

// The first axis between two points far apart, the second towards the one farthest from their line: triangles, fans and strips
// lie flat in it.
TriangleTree::TurnedBox TriangleTree::box_round(std::span<const dvec3> points) {
  TurnedBox box{.axes = static_cast<std::uint32_t>(axes_.size())};
  Axes& axes = axes_.emplace_back(axes_[0]);
  const dvec3 from = farthest(points, points[0]), longest = farthest(points, from) - from;
  if (glm::length(longest) > 0.0) {
    const dvec3 along = glm::normalize(longest);
    const auto aside = [&](const dvec3& p) { return p - from - glm::dot(p - from, along) * along; };
    const dvec3 widest = aside(*std::ranges::max_element(points, {}, [&](const dvec3& p) { return glm::length(aside(p)); }));
    const dvec3 rest = widest - glm::dot(widest, along) * along;
    const dvec3 second = glm::length(rest) > 0.0 ? glm::normalize(rest) : across(along);
    axes = {along, second, glm::cross(along, second)};
  }
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const dvec3& p : points) {
      low = std::min(low, glm::dot(axes[axis], p - from));
      high = std::max(high, glm::dot(axes[axis], p - from));
    }
    box.middle += 0.5 * (low + high) * axes[axis];
    box.half[axis] = 0.5 * (high - low);
  }
  box.middle += from;
  return box;
}

// Halves the triangles by their middles, again and again. Boxes along the axes are made from the leaves up.
class TriangleTree::Builder {
 public:
  explicit Builder(TriangleTree& tree) : tree_(tree), mesh_(tree.mesh_) {
    members_.reserve(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) members_.push_back(member(t));
    if (!members_.empty()) build(0, static_cast<std::uint32_t>(members_.size()));
  }

 private:
  struct Member {
    dvec3 sum;           // of its corners
    double slenderness;  // above zero if it is slender; adds up
    std::uint32_t triangle;
  };

  Member member(std::uint32_t triangle) const {
    const auto [a, b, c] = mesh_.corners(triangle);
    const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    return {a + b + c, longest - slender_ratio * glm::length(area_vector(a, b, c)), triangle};
  }

  Box build(std::uint32_t begin, std::uint32_t end) {
    const std::size_t at = tree_.nodes_.size();
    tree_.nodes_.push_back({{}, begin, end, 0, no_index, {no_index, no_index, no_index}});
    if (is_slender(begin, end)) turn_box(tree_.nodes_[at]);
    const Box box = end - begin <= triangles_per_leaf ? fill_leaf(at) : divide(at);
    Node& node = tree_.nodes_[at];
    if (node.box.axes == 0) node.box.middle = box.middle(), node.box.half = 0.5 * (box.high - box.low);
    return box;
  }

  bool is_slender(std::uint32_t begin, std::uint32_t end) const {
    double sum = 0.0;
    for (std::uint32_t i = begin; i < end; ++i) sum += members_[i].slenderness;
    return sum > 0.0;
  }

  void turn_box(Node& node) {
    points_.clear();
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      for (const std::uint32_t v : mesh_.triangles[members_[i].triangle]) points_.push_back(mesh_.vertices[v]);
    node.box = tree_.box_round(points_);
  }

  // In two halves, across the axis along which the middles lie farthest apart; corners may do so along another one.
  Box divide(std::size_t at) {
    const auto [begin, end] = std::pair(tree_.nodes_[at].begin, tree_.nodes_[at].end);
    const std::uint32_t middle = begin + (end - begin) / 2;
    halve(begin, middle, end, tree_.axes_[tree_.nodes_[at].box.axes]);
    Box box = build(begin, middle);
    tree_.nodes_[at].right = static_cast<std::uint32_t>(tree_.nodes_.size());
    const Box other = build(middle, end);
    box.add(other.low), box.add(other.high);
    join_children(at);
    return box;
  }

  void halve(std::uint32_t begin, std::uint32_t middle, std::uint32_t end, const Axes& axes) {
    Box middles;
    const auto first = members_.begin();
    for (auto m = first + begin; m != first + end; ++m)
      middles.add({glm::dot(axes[0], m->sum), glm::dot(axes[1], m->sum), glm::dot(axes[2], m->sum)});
    const dvec3 along = axes[longest_axis(middles.high - middles.low)];
    std::nth_element(first + begin, first + middle, first + end, [&along](const Member& a, const Member& b) {
      const double depth_a = glm::dot(along, a.sum), depth_b = glm::dot(along, b.sum);
      return depth_a != depth_b ? depth_a < depth_b : a.triangle < b.triangle;
    });
  }

  Box fill_leaf(std::size_t at) {
    Node& node = tree_.nodes_[at];
    node.patch = mesh_.triangle_patch[members_[node.begin].triangle];
    node.common = mesh_.triangles[members_[node.begin].triangle];
    Box box;
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t triangle = tree_.members_[i] = members_[i].triangle;
      keep_common(node, mesh_.triangles[triangle], mesh_.triangle_patch[triangle]);
      for (const std::uint32_t v : mesh_.triangles[triangle]) box.add(mesh_.vertices[v]);
    }
    return box;
  }

  void join_children(std::size_t at) {
    Node& node = tree_.nodes_[at];
    const Node &first = tree_.nodes_[at + 1], &second = tree_.nodes_[node.right];
    node.patch = first.patch;
    node.common = first.common;
    keep_common(node, second.common, second.patch);
  }

  static void keep_common(Node& node, const Triangle& corners, std::uint32_t patch) {
    for (std::uint32_t& v : node.common)
      if (std::ranges::find(corners, v) == corners.end()) v = no_index;
    if (patch != node.patch) node.patch = no_index;
  }

  TriangleTree& tree_;
  const TriangleMesh& mesh_;
  std::vector<Member> members_;
  std::vector<dvec3> points_;  // of one node
};

TriangleTree::TriangleTree(const TriangleMesh& mesh)
    : mesh_(mesh), members_(mesh.triangles.size()), axes_{{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}} {
  Builder{*this};
}

bool TriangleTree::are_apart(const TurnedBox& a, const TurnedBox& b, double distance) const {
  if (a.axes != 0 || b.axes != 0) return turned_are_apart(a, b, distance);
  const dvec3 gap = glm::abs(b.middle - a.middle) - (a.half + b.half);
  return std::max({gap.x, gap.y, gap.z}) > distance;
}

// Gottschalk, Lin, Manocha (1996): the normals of both boxes and the products of their edges tell. A product shorter than one
// understates the gap, which is safe.
bool TriangleTree::turned_are_apart(const TurnedBox& a, const TurnedBox& b, double distance) const {
  const Axes &axes_a = axes_[a.axes], &axes_b = axes_[b.axes];
  const dvec3 between = b.middle - a.middle;
  if (glm::length(between) > glm::length(a.half) + glm::length(b.half) + distance) return true;
  const auto separates = [&](const dvec3& axis) {
    double reach = distance;
    for (int i = 0; i < 3; ++i)
      reach += a.half[i] * std::abs(glm::dot(axes_a[i], axis)) + b.half[i] * std::abs(glm::dot(axes_b[i], axis));
    return std::abs(glm::dot(between, axis)) > reach;
  };
  if (std::ranges::any_of(axes_a, separates) || std::ranges::any_of(axes_b, separates)) return true;
  for (const dvec3& edge_a : axes_a)
    for (const dvec3& edge_b : axes_b)
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
    if (are_settled(a, b) || tree_.are_apart(a.box, b.box, distance_)) return;
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
    const Axes& axes = axes_[box.axes];
    dvec3 from, along;
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = glm::dot(axes[axis], origin - box.middle);
      along[axis] = glm::dot(axes[axis], direction);
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
