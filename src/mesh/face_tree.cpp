#include "mesh/face_tree.h"

#include <algorithm>
#include <bit>
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
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  for (const std::uint32_t f : faces.face_of_triangle) sorted.face_of_triangle.push_back(place[f]);
  return sorted;
}

// The part of `order` that falls to a lane: quarters of a list halved twice.
std::span<std::uint32_t> quarter(std::span<std::uint32_t> order, int lane) {
  const std::size_t half = order.size() / 2;
  const std::span<std::uint32_t> side = lane < 2 ? order.first(half) : order.subspan(half);
  return lane % 2 == 0 ? side.first(side.size() / 2) : side.subspan(side.size() / 2);
}

Box box_of(std::span<const Box> boxes, std::span<const std::uint32_t> order) {
  Box box;
  for (const std::uint32_t f : order) box.add(boxes[f].low), box.add(boxes[f].high);
  return box;
}

// Halves at the middle along the longest side of the box; ties go by index.
void halve(std::span<const Box> boxes, std::span<std::uint32_t> order) {
  const Box box = box_of(boxes, order);
  const dvec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto key = [&](std::uint32_t f) { return std::pair(boxes[f].low[axis] + boxes[f].high[axis], f); };
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2), {}, key);
}

}  // namespace

FaceTree::FaceTree(const TriangleMesh& mesh) : mesh_(mesh), faces_(find_faces(mesh)) {
  const std::vector<Box> boxes = boxes_of(mesh, faces_);
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  if (!boxes.empty()) build(boxes, order, 0);
  faces_ = in_order(faces_, order);
}

std::uint32_t FaceTree::build(std::span<const Box> boxes, std::span<std::uint32_t> order, std::uint32_t begin) {
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  halve(boxes, order);
  halve(boxes, order.first(order.size() / 2));
  halve(boxes, order.subspan(order.size() / 2));
  for (int lane = 0; lane < lanes; ++lane) {
    const std::span<std::uint32_t> part = quarter(order, lane);
    set_lane(node, lane, boxes, part, begin + static_cast<std::uint32_t>(part.data() - order.data()));
  }
  return node;
}

void FaceTree::set_lane(std::uint32_t node, int lane, std::span<const Box> boxes, std::span<std::uint32_t> order,
                        std::uint32_t begin) {
  const Box box = box_of(boxes, order);
  const dvec3 middle = order.empty() ? dvec3(0.0) : box.middle(),
              half = order.empty() ? dvec3(-std::numeric_limits<double>::infinity()) : 0.5 * (box.high - box.low);
  const std::uint32_t child = order.size() > faces_per_leaf ? build(boxes, order, begin) : 0;
  Node& n = nodes_[node];
  n.x[lane] = middle.x, n.y[lane] = middle.y, n.z[lane] = middle.z;
  n.half_x[lane] = half.x, n.half_y[lane] = half.y, n.half_z[lane] = half.z;
  n.begin[lane] = begin, n.end[lane] = begin + static_cast<std::uint32_t>(order.size());
  n.child[lane] = child;
}

// A prism as slabs: directions, how much of each a box's sides cover, and the bounds along them.
struct FaceTree::Query {
  struct Slab {
    dvec3 axis, cover;
    double low, high;
    auto touched(const Node& n) const {
      const Lanes at = axis.x * n.x + axis.y * n.y + axis.z * n.z;
      const Lanes reach = cover.x * n.half_x + cover.y * n.half_y + cover.z * n.half_z;
      return (at + reach >= low) & (at - reach <= high);
    }
  };

  explicit Query(const Prism& p) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto slab = [&](int i, const dvec3& axis, double low, double high) {
      const double base = glm::dot(axis, p.base);
      slabs[i] = {axis, glm::abs(axis), low + base, high + base};
    };
    slab(0, p.u_hat, p.low.x, p.high.x);
    slab(1, p.v_hat, p.low.y, p.high.y);
    slab(2, p.direction, -infinity, p.farthest);
    if (!p.floor) return;
    const double sign = glm::dot(p.floor->normal, p.direction) > 0.0 ? 1.0 : -1.0;
    slabs[3] = {sign * p.floor->normal, glm::abs(p.floor->normal), sign * p.floor->offset, infinity};
    count = 4;
  }

  // Bit l: the box of lane l reaches into all slabs.
  unsigned touched(const Node& n) const {
    auto inside = slabs[0].touched(n);
    for (int i = 1; i < count; ++i) inside &= slabs[i].touched(n);
    unsigned bits = 0;
    for (int l = 0; l < lanes; ++l) bits |= (inside[l] ? 1u : 0u) << l;
    return bits;
  }

  std::array<Slab, 4> slabs;
  int count = 3;
};

void FaceTree::collect(const Prism& prism, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  const Query query(prism);
  std::array<std::uint32_t, 3 * 17> pending;  // three for each of the at most 16 levels of 2^32 faces
  std::size_t count = 0;
  pending[count++] = 0;
  while (count) {
    const Node& node = nodes_[pending[--count]];
    for (unsigned bits = query.touched(node); bits; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      if (node.child[lane])
        pending[count++] = node.child[lane];
      else
        for (std::uint32_t f = node.begin[lane]; f < node.end[lane]; ++f) found.push_back(f);
    }
  }
}

}  // namespace raytube
