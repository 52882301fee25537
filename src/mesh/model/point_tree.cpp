#include "mesh/model/point_tree.h"

#include <algorithm>
#include <array>

namespace raytube {

namespace {

constexpr std::uint32_t points_per_leaf = 8;

/// Clips the line a + t (b - a), 0 <= t <= 1, by the box grown by `margin`; true if something is left.
bool segment_meets_box(const dvec3& a, const dvec3& b, const Box& box, double margin) {
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis] - margin - a[axis], high = box.high[axis] + margin - a[axis], step = b[axis] - a[axis];
    if (step == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    const auto [near, far] = std::minmax({low / step, high / step});
    enter = std::max(enter, near);
    leave = std::min(leave, far);
  }
  return enter <= leave;
}

}  // namespace

double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 ab = b - a;
  const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::distance(p, a + t * ab);
}

PointTree::PointTree(std::span<const dvec3> points, std::vector<std::uint32_t> members)
    : points_(points), members_(std::move(members)) {
  if (!members_.empty()) build(0, static_cast<std::uint32_t>(members_.size()));
}

void PointTree::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t self = nodes_.size();
  Box box;
  for (std::uint32_t i = begin; i < end; ++i) box.add(points_[members_[i]]);
  nodes_.push_back({box, begin, end});
  if (end - begin <= points_per_leaf) return;
  const int axis = longest_axis(box.high - box.low);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(members_.begin() + begin, members_.begin() + middle, members_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
  build(begin, middle);
  nodes_[self].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

void PointTree::near_segment(const dvec3& a, const dvec3& b, double distance, std::vector<std::uint32_t>& found) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> stack;  // the halves keep the depth below 33
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    if (!segment_meets_box(a, b, node.box, distance)) continue;
    if (node.right != 0) {
      stack[depth++] = node.right;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      if (distance_to_segment(points_[members_[i]], a, b) <= distance) found.push_back(members_[i]);
  }
}

}  // namespace raytube
