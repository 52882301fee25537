#include "mesh/repair/separate.h"

#include <algorithm>
#include <cmath>

#include "mesh/model/edge_table.h"

namespace raytube {

namespace {

/// Triangles at angles closer than this [rad] lie on one another.
constexpr double same_angle = 1e-6;

struct Leaf {
  EdgeTable::Side side;
  bool forward;  // winding from the edge's lower vertex to its higher one: the back is on the clockwise side
  double angle;  // counter-clockwise about the edge, from the first leaf
};

dvec3 perpendicular(const dvec3& v, const dvec3& axis) { return v - glm::dot(v, axis) * axis; }

/// In order of angle. Of leaves that lie on one another those with their back on the clockwise side come first: they bound
/// bodies that touch, not bodies inside one another.
std::vector<Leaf> sorted_leaves(std::span<const dvec3> vertices, std::span<const Triangle> triangles,
                                const EdgeTable::Edge& edge) {
  const dvec3 origin = vertices[edge.low], axis = glm::normalize(vertices[edge.high] - origin);
  std::vector<Leaf> leaves;
  dvec3 x(0.0), y(0.0);
  for (const EdgeTable::Side& side : edge.sides) {
    const Triangle& t = triangles[side.triangle];
    const dvec3 into = perpendicular(vertices[t[(side.corner + 2) % 3]] - origin, axis);
    if (leaves.empty()) {
      x = into;
      y = glm::cross(axis, into);
    }
    const double angle = std::atan2(glm::dot(into, y), glm::dot(into, x));
    leaves.push_back({side, t[side.corner] == edge.low, angle < -same_angle ? angle + 2.0 * pi : angle});
  }
  std::ranges::stable_sort(leaves, {}, &Leaf::angle);
  for (auto first = leaves.begin(); first != leaves.end();) {
    const auto last = std::find_if(first, leaves.end(), [&](const Leaf& leaf) { return leaf.angle > first->angle + same_angle; });
    std::stable_partition(first, last, [](const Leaf& leaf) { return leaf.forward; });
    first = last;
  }
  return leaves;
}

}  // namespace

SeparateSoup separate_bodies(std::span<const dvec3> vertices, std::span<const Triangle> triangles) {
  const EdgeTable edges(triangles, vertices.size());
  DisjointSets corners(3 * triangles.size());
  const auto join = [&](const EdgeTable::Edge& edge, const EdgeTable::Side& a, const EdgeTable::Side& b) {
    const auto corner = [&](std::uint32_t triangle, std::uint32_t vertex) {
      return 3 * triangle + corner_at(triangles[triangle], vertex);
    };
    for (const std::uint32_t vertex : {edge.low, edge.high}) corners.join(corner(b.triangle, vertex), corner(a.triangle, vertex));
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeTable::Edge edge = edges[e];
    if (edge.sides.size() == 2) join(edge, edge.sides[0], edge.sides[1]);
    if (edge.sides.size() <= 2) continue;
    const std::vector<Leaf> leaves = sorted_leaves(vertices, triangles, edge);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Leaf &leaf = leaves[i], &next = leaves[(i + 1) % leaves.size()];
      if (!leaf.forward && next.forward) join(edge, leaf.side, next.side);
    }
  }
  const std::vector<std::uint32_t> numbers = corners.numbers();
  SeparateSoup soup;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Triangle& copy = soup.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      copy[k] = numbers[3 * std::size_t{i} + k];
      if (copy[k] == soup.vertex_of.size()) soup.vertex_of.push_back(triangles[i][k]);
    }
  }
  return soup;
}

}  // namespace raytube
