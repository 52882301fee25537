#include "mesh/stacked.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>

#include "mesh/geometry.h"

namespace raytube {

namespace {

using TriangleBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

// Cosine of 1e-4 rad: planes that open faster are told apart by single precision a few of its roundings beside their line.
constexpr double almost_parallel = 1.0 - 5e-9;

std::vector<TriangleBox> boxes_of(const TriangleMesh& mesh, double margin) {
  std::vector<TriangleBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Box box;
    for (const std::uint32_t v : mesh.triangles[t]) box.add(mesh.vertices[v]);
    box.low -= margin;
    box.high += margin;
    boxes.emplace_back(CGAL::Bbox_3(box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z), t);
  }
  return boxes;
}

struct Interval {
  double low, high;
};

Interval along(const TriangleMesh& mesh, std::uint32_t triangle, const dvec3& axis) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const double x = glm::dot(mesh.vertices[a], axis), y = glm::dot(mesh.vertices[b], axis), z = glm::dot(mesh.vertices[c], axis);
  return {std::min({x, y, z}), std::max({x, y, z})};
}

// One of the edges of `of` separates the two triangles within their common plane.
bool separated_by_an_edge(const TriangleMesh& mesh, std::uint32_t of, std::uint32_t other, const dvec3& normal, double distance) {
  for (int k = 0; k < 3; ++k) {
    const auto& corners = mesh.triangles[of];
    const dvec3 edge = mesh.vertices[corners[(k + 1) % 3]] - mesh.vertices[corners[k]];
    const dvec3 axis = glm::normalize(glm::cross(normal, edge));
    const Interval a = along(mesh, of, axis), b = along(mesh, other, axis);
    if (std::min(a.high, b.high) - std::max(a.low, b.low) <= distance) return true;
  }
  return false;
}

bool are_stacked(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, double distance) {
  if (mesh.triangle_patch[a] == mesh.triangle_patch[b]) return false;
  const Patch &first = mesh.patches[mesh.triangle_patch[a]], &second = mesh.patches[mesh.triangle_patch[b]];
  if (std::abs(glm::dot(first.normal, second.normal)) < almost_parallel) return false;
  const Interval heights = along(mesh, b, first.normal);
  if (heights.low > first.offset + distance || heights.high < first.offset - distance) return false;
  return !separated_by_an_edge(mesh, a, b, first.normal, distance) && !separated_by_an_edge(mesh, b, a, first.normal, distance);
}

}  // namespace

std::vector<bool> find_stacked_triangles(const TriangleMesh& mesh, double distance) {
  std::vector<bool> stacked(mesh.triangles.size(), false);
  std::vector<TriangleBox> boxes = boxes_of(mesh, distance);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const TriangleBox& a, const TriangleBox& b) {
    if (are_stacked(mesh, a.info(), b.info(), distance)) stacked[a.info()] = stacked[b.info()] = true;
  });
  return stacked;
}

}  // namespace raytube
