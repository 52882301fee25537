#include "mesh/exact_hit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/geometry.h"
#include "mesh/stacked.h"

namespace raytube {

ExactHit::ExactHit(const TriangleMesh& mesh)
    : mesh_(mesh),
      // A point on the ray and a plane offset each carry a few roundings of numbers up to the radius.
      rounding_(8.0 * std::numeric_limits<double>::epsilon() * mesh.radius),
      // Float coordinates of size <= radius round by 6e-8 of it; origin, vertices and edge functions add up to some tens of that.
      doubt_(2e-6 * mesh.radius),
      stacked_(find_stacked_triangles(mesh, doubt_)),
      first_(mesh.vertices.size() + 1, 0) {
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) ++first_[vertex + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  incident_.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  balls_.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) balls_.push_back(ball(t));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t]) incident_[next[vertex]++] = t;
}

double ExactHit::safe_side(std::uint32_t triangle) const {
  if (stacked_[triangle]) return std::numeric_limits<double>::infinity();
  const int corner = longest_edge(mesh_.vertices, mesh_.triangles[triangle]);
  const auto& corners = mesh_.triangles[triangle];
  return 2.0 * doubt_ * glm::distance(mesh_.vertices[corners[corner]], mesh_.vertices[corners[(corner + 1) % 3]]);
}

// About the centroid; wider by the doubt, far more than single precision can move it.
ExactHit::Ball ExactHit::ball(std::uint32_t triangle) const {
  const auto& [i, j, k] = mesh_.triangles[triangle];
  const dvec3 middle = (mesh_.vertices[i] + mesh_.vertices[j] + mesh_.vertices[k]) / 3.0;
  double radius = 0.0;
  for (const std::uint32_t vertex : mesh_.triangles[triangle])
    radius = std::max(radius, glm::distance(middle, mesh_.vertices[vertex]));
  return {glm::vec3(middle), static_cast<float>(radius + doubt_)};
}

namespace {

// Volume spanned by a ray's direction and an edge between corners a and b (seen from the ray's origin), of vertices `from` and
// `to`: positive on one side of the edge, negative on the other. Always from the lower vertex to the higher one, so that the
// two triangles of an edge compute the same number.
double edge_side(const dvec3& direction, const dvec3& a, const dvec3& b, bool swapped) {
  return swapped ? -glm::dot(direction, glm::cross(b, a)) : glm::dot(direction, glm::cross(a, b));
}

bool same_sign(const std::array<double, 3>& s) {
  return (s[0] >= 0.0 && s[1] >= 0.0 && s[2] >= 0.0) || (s[0] <= 0.0 && s[1] <= 0.0 && s[2] <= 0.0);
}

}  // namespace

std::array<double, 3> ExactHit::edge_sides(const Ray& ray, std::uint32_t triangle) const {
  const auto& [i, j, k] = mesh_.triangles[triangle];
  const dvec3 a = mesh_.vertices[i] - ray.origin, b = mesh_.vertices[j] - ray.origin, c = mesh_.vertices[k] - ray.origin;
  const dvec3& d = ray.direction;
  return {edge_side(d, a, b, i > j), edge_side(d, b, c, j > k), edge_side(d, c, a, k > i)};
}

bool ExactHit::contains(const Ray& ray, std::uint32_t triangle) const { return same_sign(edge_sides(ray, triangle)); }

bool ExactHit::is_safe(const Ray& ray, std::uint32_t triangle) const {
  if (stacked_[triangle]) return false;
  const std::array<double, 3> sides = edge_sides(ray, triangle);
  if (!same_sign(sides)) return false;
  const auto& [i, j, k] = mesh_.triangles[triangle];
  const dvec3 edges[3] = {mesh_.vertices[j] - mesh_.vertices[i], mesh_.vertices[k] - mesh_.vertices[j],
                          mesh_.vertices[i] - mesh_.vertices[k]};
  // Side over edge length is at most the distance between the two lines.
  for (int e = 0; e < 3; ++e)
    if (sides[e] * sides[e] < doubt_ * doubt_ * glm::dot(edges[e], edges[e])) return false;
  return true;
}

double ExactHit::depth_doubt(const Ray& ray, std::uint32_t triangle) const {
  return doubt_ / std::abs(glm::dot(mesh_.patches[patch(triangle)].normal, ray.direction));
}

Hit ExactHit::nearest_around(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const {
  Hit nearest;
  const auto consider = [&](std::uint32_t candidate) {
    if (std::ranges::find(ignored_patches, patch(candidate)) != ignored_patches.end()) return;
    if (!ahead(ray, candidate) || !contains(ray, candidate)) return;
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
