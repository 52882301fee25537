#include "mesh/face_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raytube {

namespace {

constexpr std::size_t faces_per_leaf = 2;

std::vector<Box> boxes_of(const TriangleMesh& mesh, const Faces& faces) {
  std::vector<Box> boxes(faces.faces.size());
  for (std::size_t f = 0; f < boxes.size(); ++f)
    for (const std::uint32_t corner : faces.corners_of(faces.faces[f])) boxes[f].add(mesh.vertices[corner]);
  return boxes;
}

Faces in_order(const Faces& faces, std::span<const std::uint32_t> order) {
  Faces sorted;
  sorted.corners.reserve(faces.corners.size());
  for (const std::uint32_t f : order) {
    Face face = faces.faces[f];
    const auto corners = faces.corners_of(face);
    face.first_corner = static_cast<std::uint32_t>(sorted.corners.size());
    sorted.corners.insert(sorted.corners.end(), corners.begin(), corners.end());
    sorted.faces.push_back(face);
  }
  return sorted;
}

// A prism's directions with the share each axis of a box has in them.
struct PrismTest {
  explicit PrismTest(const Prism& p)
      : prism(p), abs_u(glm::abs(p.u_hat)), abs_v(glm::abs(p.v_hat)), abs_direction(glm::abs(p.direction)) {
    if (!p.floor) return;
    const bool up = glm::dot(p.floor->normal, p.direction) > 0.0;
    floor_normal = up ? p.floor->normal : -p.floor->normal;
    floor_offset = up ? p.floor->offset : -p.floor->offset;
    abs_floor = glm::abs(floor_normal);
  }

  bool touches(const dvec3& middle, const dvec3& half) const {
    const dvec3 m = middle - prism.base;
    const double u = glm::dot(prism.u_hat, m), half_u = glm::dot(abs_u, half);
    if (u + half_u < prism.low.x || u - half_u > prism.high.x) return false;
    const double v = glm::dot(prism.v_hat, m), half_v = glm::dot(abs_v, half);
    if (v + half_v < prism.low.y || v - half_v > prism.high.y) return false;
    if (glm::dot(prism.direction, m) - glm::dot(abs_direction, half) > prism.farthest) return false;
    return !prism.floor || glm::dot(floor_normal, middle) + glm::dot(abs_floor, half) > floor_offset;
  }

  const Prism& prism;
  dvec3 abs_u, abs_v, abs_direction;
  dvec3 floor_normal{0.0}, abs_floor{0.0};
  double floor_offset = 0.0;
};

}  // namespace

FaceTree::FaceTree(const TriangleMesh& mesh) : mesh_(mesh), faces_(find_faces(mesh)) {
  const std::vector<Box> boxes = boxes_of(mesh, faces_);
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, order, 0);
  faces_ = in_order(faces_, order);
}

// Halves the faces at the middle one along the box's longest side.
void FaceTree::build(std::span<const Box> boxes, std::span<std::uint32_t> order, std::uint32_t begin) {
  Box box;
  for (const std::uint32_t f : order) box.add(boxes[f].low), box.add(boxes[f].high);
  const std::size_t node = nodes_.size();
  nodes_.push_back({box.middle(), 0.5 * (box.high - box.low), begin, begin + static_cast<std::uint32_t>(order.size()), 0});
  if (order.size() <= faces_per_leaf) return;
  const dvec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto key = [&](std::uint32_t f) { return std::pair(boxes[f].low[axis] + boxes[f].high[axis], f); };
  const std::size_t half = order.size() / 2;
  std::ranges::nth_element(order, order.begin() + half, {}, key);
  build(boxes, order.first(half), begin);
  nodes_[node].second_child = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, order.subspan(half), begin + static_cast<std::uint32_t>(half));
}

void FaceTree::collect(const Prism& prism, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  const PrismTest test(prism);
  std::uint32_t pending[64], count = 0;  // halving leaves at most 32 levels
  for (std::uint32_t n = 0;;) {
    const Node& node = nodes_[n];
    if (test.touches(node.middle, node.half)) {
      if (node.second_child) {
        pending[count++] = node.second_child;
        ++n;
        continue;
      }
      for (std::uint32_t f = node.begin; f < node.end; ++f) found.push_back(f);
    }
    if (count == 0) return;
    n = pending[--count];
  }
}

}  // namespace raytube
