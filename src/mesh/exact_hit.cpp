#include "mesh/exact_hit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

ExactHit::ExactHit(const TriangleMesh& mesh)
    : mesh_(mesh),
      // A point on the ray and a plane offset each carry a few roundings of numbers up to the radius.
      rounding_(8.0 * std::numeric_limits<double>::epsilon() * mesh.radius),
      // Float coordinates of size <= radius round by 6e-8 of it; origin, vertices and edge functions add up to some tens of that.
      doubt_(2e-6 * mesh.radius),
      first_(mesh.vertices.size() + 1, 0) {
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) ++first_[vertex + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  incident_.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t]) incident_[next[vertex]++] = t;
}

double ExactHit::distance(const Ray& ray, std::uint32_t triangle) const {
  const Patch& plane = mesh_.patches[patch(triangle)];
  return (plane.offset - glm::dot(plane.normal, ray.origin)) / glm::dot(plane.normal, ray.direction);
}

bool ExactHit::ahead(const Ray& ray, std::uint32_t triangle) const {
  const Patch& plane = mesh_.patches[patch(triangle)];
  const double height = plane.offset - glm::dot(plane.normal, ray.origin);
  return std::abs(height) > rounding_ && height * glm::dot(plane.normal, ray.direction) > 0.0;
}

// Volume spanned by the ray and the edge, over the edge's length. Always from the lower vertex to the higher one, so that
// the two triangles of an edge compute the same number.
double ExactHit::edge_side(const Ray& ray, std::uint32_t from, std::uint32_t to) const {
  const bool swapped = from > to;
  if (swapped) std::swap(from, to);
  const dvec3 a = mesh_.vertices[from] - ray.origin, b = mesh_.vertices[to] - ray.origin;
  const double side = glm::dot(ray.direction, glm::cross(a, b)) / glm::length(b - a);
  return swapped ? -side : side;
}

double ExactHit::clearance(const Ray& ray, std::uint32_t triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  const double sides[3] = {edge_side(ray, a, b), edge_side(ray, b, c), edge_side(ray, c, a)};
  // All three have the sign of the ray's passage when it runs through the triangle, from either side.
  const double lowest = std::min({sides[0], sides[1], sides[2]}), highest = std::max({sides[0], sides[1], sides[2]});
  return std::max(lowest, -highest);
}

Hit ExactHit::nearest_around(const Ray& ray, std::uint32_t triangle, const std::array<std::uint32_t, 2>& ignored_patches) const {
  Hit nearest;
  const auto consider = [&](std::uint32_t candidate) {
    if (std::ranges::find(ignored_patches, patch(candidate)) != ignored_patches.end()) return;
    if (!ahead(ray, candidate) || clearance(ray, candidate) < 0.0) return;
    const Hit hit{candidate, distance(ray, candidate)};
    const bool nearer =
        !nearest || hit.distance < nearest.distance || (hit.distance == nearest.distance && hit.triangle < nearest.triangle);
    if (nearer) nearest = hit;
  };
  for (const std::uint32_t vertex : mesh_.triangles[triangle])
    for (const std::uint32_t candidate : around(vertex)) consider(candidate);
  return nearest;
}

std::span<const std::uint32_t> ExactHit::around(std::uint32_t vertex) const {
  return {incident_.data() + first_[vertex], incident_.data() + first_[vertex + 1]};
}

}  // namespace raytube
