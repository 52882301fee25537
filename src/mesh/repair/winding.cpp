#include "mesh/repair/winding.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

namespace {

/// Floods the triangles across their edges: which are to be turned over. Nothing if more than two meet at an edge, or if the
/// surface comes back to a triangle from its other side.
std::optional<std::vector<bool>> reversed_of_manifold(std::span<const Triangle> triangles, const EdgeTable& edges) {
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].sides.size() > 2) return {};
  std::vector<bool> reached(triangles.size(), false), reversed(triangles.size(), false);
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (reached[first]) continue;
    reached[first] = true;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const std::uint32_t triangle = waiting.back();
      waiting.pop_back();
      for (int corner = 0; corner < 3; ++corner) {
        const EdgeTable::Edge edge = edges[edges.edge_of(triangle, corner)];
        if (edge.sides.size() < 2) continue;
        const auto& [next, next_corner] = edge.beside(triangle);
        const bool turned = (triangles[next][next_corner] == triangles[triangle][corner]) != reversed[triangle];
        if (reached[next] && reversed[next] != turned) return {};
        if (reached[next]) continue;
        reached[next] = true;
        reversed[next] = turned;
        waiting.push_back(next);
      }
    }
  }
  return reversed;
}

/// A surface goes on across an edge where two triangles, turned over as they are to be, run along it in opposite senses.
Winding winding_of(const SeparateSoup& soup, const EdgeTable& edges, std::vector<bool> reversed) {
  const auto starts_low = [&](const EdgeTable::Edge& edge, const EdgeTable::Side& side) {
    return (soup.triangles[side.triangle][side.corner] == edge.low) != reversed[side.triangle];
  };
  const auto goes_on = [&](const EdgeTable::Edge& edge) {
    return edge.sides.size() == 2 && starts_low(edge, edge.sides[0]) != starts_low(edge, edge.sides[1]);
  };
  Winding winding{connected_groups(edges, soup.triangles.size(), goes_on), {}, {}};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeTable::Edge edge = edges[e];
    if (goes_on(edge)) continue;
    const std::uint32_t low = soup.vertex_of[edge.low], high = soup.vertex_of[edge.high];
    for (const EdgeTable::Side& side : edge.sides) {
      const int sense = (low < high) == starts_low(edge, side) ? -1 : 1;  // against that of the triangle
      winding.border.push_back({winding.component[side.triangle], std::min(low, high), std::max(low, high), sense});
    }
  }
  winding.reversed = std::move(reversed);
  return winding;
}

}  // namespace

Winding wind_alike(std::span<const dvec3> vertices, const SeparateSoup& soup) {
  const EdgeTable edges(soup.triangles, soup.vertex_of.size());
  if (std::optional<std::vector<bool>> reversed = reversed_of_manifold(soup.triangles, edges))
    return winding_of(soup, edges, std::move(*reversed));
  SeparateSoup cut = soup;
  std::vector<bool> reversed = cut_and_wind(vertices, cut);
  Winding winding = winding_of(cut, EdgeTable(cut.triangles, cut.vertex_of.size()), std::vector<bool>(reversed.size(), false));
  winding.reversed = std::move(reversed);
  return winding;
}

}  // namespace raytube
