#include "mesh/model/face_tree.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace raytube {

namespace {

std::vector<BoxedFace> boxed_faces(const TriangleMesh& mesh, const Faces& faces) {
  std::vector<BoxedFace> boxed(faces.faces.size());
  for (std::uint32_t f = 0; f < boxed.size(); ++f) {
    boxed[f].face = f;
    for (const std::uint32_t corner : faces.corners_of(faces.faces[f])) boxed[f].box.add(mesh.vertices[corner]);
  }
  return boxed;
}

Faces in_order(const Faces& faces, std::span<const BoxedFace> order) {
  Faces sorted;
  sorted.corners.reserve(faces.corners.size());
  sorted.faces.reserve(order.size());
  for (const BoxedFace& boxed : order) {
    Face face = faces.faces[boxed.face];
    const auto corners = faces.corners_of(face);
    face.first_corner = static_cast<std::uint32_t>(sorted.corners.size());
    sorted.corners.insert(sorted.corners.end(), corners.begin(), corners.end());
    sorted.faces.push_back(face);
  }
  std::vector<std::uint32_t> index(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) index[order[i].face] = i;
  sorted.face_of_triangle.reserve(faces.face_of_triangle.size());
  for (const std::uint32_t f : faces.face_of_triangle) sorted.face_of_triangle.push_back(index[f]);
  return sorted;
}

Box box_of(std::span<const BoxedFace> faces) {
  Box box;
  for (const BoxedFace& f : faces) box.add(f.box.low), box.add(f.box.high);
  return box;
}

// Halves along the longest side of the box, again and again; every part but the last one has `full` faces. Ties go by index.
void divide(std::span<BoxedFace> order, std::size_t full, std::span<std::span<BoxedFace>> parts) {
  if (parts.size() == 1) {
    parts[0] = order;
    return;
  }
  const Box box = box_of(order);
  const int axis = longest_axis(box.high - box.low);
  const auto key = [axis](const BoxedFace& f) { return std::pair(f.box.low[axis] + f.box.high[axis], f.face); };
  const std::size_t middle = parts.size() / 2, half = middle * full;
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(half), {}, key);
  divide(order.first(half), full, parts.first(middle));
  divide(order.subspan(half), full, parts.subspan(middle));
}

}  // namespace

FaceTree::FaceTree(const TriangleMesh& mesh)
    : mesh_(mesh),
      faces_(find_faces(mesh)),
      // A dozen roundings of numbers up to the radius, in the box and in the prism.
      box_rounding_(16.0 * std::numeric_limits<float>::epsilon() * mesh.radius) {
  std::vector<BoxedFace> order = boxed_faces(mesh, faces_);
  if (!order.empty()) build(order, 0);
  faces_ = in_order(faces_, order);
  nodes_.shrink_to_fit();
  triangles_ = triangle_rows(faces_.faces.size(), faces_.face_of_triangle);
}

// All nodes but the last of each level are full, so that few are looked at; the root may not be.
std::uint32_t FaceTree::build(std::span<BoxedFace> order, std::uint32_t begin) {
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  std::size_t full = 1;
  while (full * lanes < order.size()) full *= lanes;
  std::array<std::span<BoxedFace>, lanes> parts;
  divide(order, full, std::span(parts).first((order.size() + full - 1) / full));
  for (int lane = 0; lane < lanes; ++lane) {
    const std::span<BoxedFace> part = parts[lane];
    const auto first = part.empty() ? begin : begin + static_cast<std::uint32_t>(part.data() - order.data());
    const std::uint32_t child = part.size() > 1 ? build(part, first) : 0;
    set_lane(node, lane, box_of(part), first, first + static_cast<std::uint32_t>(part.size()), child);
  }
  return node;
}

void FaceTree::set_lane(std::uint32_t node, int lane, const Box& box, std::uint32_t begin, std::uint32_t end,
                        std::uint32_t child) {
  const bool used = begin < end;
  const dvec3 middle = used ? box.middle() : dvec3(0.0),
              half = used ? 0.5 * (box.high - box.low) + box_rounding_ : dvec3(-std::numeric_limits<double>::infinity());
  Node& n = nodes_[node];
  n.x[lane] = static_cast<float>(middle.x), n.half_x[lane] = static_cast<float>(half.x);
  n.y[lane] = static_cast<float>(middle.y), n.half_y[lane] = static_cast<float>(half.y);
  n.z[lane] = static_cast<float>(middle.z), n.half_z[lane] = static_cast<float>(half.z);
  n.begin[lane] = begin, n.end[lane] = end, n.child[lane] = child;
}

// A prism as slabs and half spaces: directions, how much of each a box's sides cover, and the bounds along them.
struct FaceTree::Query {
  struct Side {
    glm::vec3 axis, cover;
    float low;
    Side() = default;
    Side(const dvec3& direction, double least) : axis(direction), cover(glm::abs(direction)), low(static_cast<float>(least)) {}
    Lanes at(const Node& n) const { return axis.x * n.x + axis.y * n.y + axis.z * n.z; }
    Lanes reach(const Node& n) const { return cover.x * n.half_x + cover.y * n.half_y + cover.z * n.half_z; }
    auto touched(const Node& n) const { return at(n) + reach(n) >= low; }
  };
  struct Slab : Side {
    float high;
    Slab(const dvec3& direction, double least, double most) : Side(direction, least), high(static_cast<float>(most)) {}
    auto touched(const Node& n) const {
      const Lanes middle = at(n), half = reach(n);
      return (middle + half >= low) & (middle - half <= high);
    }
  };

  explicit Query(const Prism& p)
      : slabs{slab(p.base, p.u_hat, p.low.x, p.high.x), slab(p.base, p.v_hat, p.low.y, p.high.y),
              slab(p.base, p.direction, -std::numeric_limits<double>::infinity(), p.farthest)},
        count(p.side_count) {
    for (std::size_t i = 0; i < count; ++i) sides[i] = {p.sides[i].axis, p.sides[i].least};
  }

  static Slab slab(const dvec3& base, const dvec3& axis, double low, double high) {
    const double from = glm::dot(axis, base);
    return {axis, low + from, high + from};
  }

  // Bit l: the box of lane l reaches into all slabs and half spaces.
  unsigned touched(const Node& n) const {
    unsigned inside = bits(slabs[0].touched(n) & slabs[1].touched(n) & slabs[2].touched(n));
    for (std::size_t i = 0; i < count && inside; ++i) inside &= bits(sides[i].touched(n));
    return inside;
  }

  template <class Mask>
  static unsigned bits(const Mask& lanes_inside) {
    return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(lanes_inside)));
  }

  std::array<Slab, 3> slabs;
  std::array<Side, Prism::most_sides> sides;
  std::size_t count;
};

void FaceTree::collect(const Prism& prism, std::vector<std::uint32_t>& found, std::size_t most) const {
  found.clear();
  if (nodes_.empty()) return;
  const Query query(prism);
  std::array<std::uint32_t, 7 * 12> pending;  // seven for each of the at most 11 levels of 2^32 faces
  std::size_t count = 0;
  pending[count++] = 0;
  while (count && found.size() <= most) {
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
