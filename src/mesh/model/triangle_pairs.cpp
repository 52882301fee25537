#include "mesh/model/triangle_pairs.h"

#include <algorithm>
#include <cmath>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

// The gap between two triangles along an axis, above zero if they are apart, times the length of the axis.
double scaled_gap_along(const Corners& a, const Corners& b, const dvec3& axis) {
  const auto range = [&](const Corners& corners) {
    return std::minmax({glm::dot(corners[0], axis), glm::dot(corners[1], axis), glm::dot(corners[2], axis)});
  };
  const auto [low_a, high_a] = range(a);
  const auto [low_b, high_b] = range(b);
  return std::max(low_a - high_b, low_b - high_a);
}

// Whether the gap is wider than `distance`, which is no less than zero; an axis without length tells nothing.
bool separates(const Corners& a, const Corners& b, const dvec3& axis, double distance) {
  const double gap = scaled_gap_along(a, b, axis);
  return gap > 0.0 && gap / glm::length(axis) > distance;
}

// Whether the two cover one another along the axis by at least `least`.
bool overlap_along(const Corners& a, const Corners& b, const dvec3& axis, double least) {
  const double length = glm::length(axis);
  return length > 0.0 && scaled_gap_along(a, b, axis) / length <= -least;
}

// Whether boxes along the axes of space tell already that the two are apart.
bool boxes_are_apart(const Corners& a, const Corners& b, double distance) {
  const dvec3 low_a = glm::min(glm::min(a[0], a[1]), a[2]), high_a = glm::max(glm::max(a[0], a[1]), a[2]);
  const dvec3 low_b = glm::min(glm::min(b[0], b[1]), b[2]), high_b = glm::max(glm::max(b[0], b[1]), b[2]);
  const dvec3 gap = glm::max(low_a - high_b, low_b - high_a);
  return std::max({gap.x, gap.y, gap.z}) > distance;
}

}  // namespace

bool are_apart(const Corners& a, const Corners& b, double distance) {
  if (boxes_are_apart(a, b, distance)) return true;
  const dvec3 normals[2] = {area_vector(a[0], a[1], a[2]), area_vector(b[0], b[1], b[2])};
  for (const dvec3& normal : normals)
    if (separates(a, b, normal, distance)) return true;
  for (int i = 0; i < 3; ++i) {
    const dvec3 edge_a = a[(i + 1) % 3] - a[i], edge_b = b[(i + 1) % 3] - b[i];
    if (separates(a, b, glm::cross(normals[0], edge_a), distance)) return true;
    if (separates(a, b, glm::cross(normals[1], edge_b), distance)) return true;
    for (int j = 0; j < 3; ++j)
      if (separates(a, b, glm::cross(edge_a, b[(j + 1) % 3] - b[j]), distance)) return true;
  }
  return false;
}

bool lie_upon_one_another(const Corners& a, const Corners& b, double distance) {
  const dvec3 normal_a = area_vector(a[0], a[1], a[2]), normal_b = area_vector(b[0], b[1], b[2]);
  // The larger one knows the plane better.
  const dvec3 normal = glm::normalize(glm::length(normal_a) > glm::length(normal_b) ? normal_a : normal_b);
  const auto is_beside = [&](const dvec3& p) { return std::abs(glm::dot(p - a[0], normal)) > distance; };
  if (std::ranges::any_of(a, is_beside) || std::ranges::any_of(b, is_beside)) return false;
  for (int i = 0; i < 3; ++i)
    for (const Corners& corners : {a, b})
      if (!overlap_along(a, b, glm::cross(normal, corners[(i + 1) % 3] - corners[i]), distance)) return false;
  return true;
}

double solid_angle(const Corners& corners) {
  const auto& [a, b, c] = corners;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), below);
}

void collect_within(const FaceTree& faces, const Box& box, std::vector<std::uint32_t>& found) {
  Prism prism{dvec3(0.0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, dvec2(box.low), dvec2(box.high), box.high.z};
  prism.add({prism.direction, box.low.z});
  faces.collect(prism, found);
}

void collect_near(const FaceTree& faces, const Corners& corners, double margin, std::vector<std::uint32_t>& found) {
  const Box box = bounding_box(corners);
  collect_within(faces, {box.low - margin, box.high + margin}, found);
}

double winding_number(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const dvec3& point) {
  double sum = 0.0;
  for (const std::uint32_t t : triangles) {
    const auto [a, b, c] = mesh.corners(t);
    sum += solid_angle({a - point, b - point, c - point});
  }
  return sum / (4.0 * pi);
}

}  // namespace raytube
