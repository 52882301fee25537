#include "mesh/exact_hit.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "mesh/exact_sign.h"
#include "mesh/geometry.h"

namespace raytube {

namespace {

// In radii of the mesh. Float coordinates of size one round by 6e-8; origin, vertices and edge functions add up to ten of that,
// and the largest displacement of a hit found in tests is 1e-6. Two surfaces that far apart are told from one another; two that
// open by the narrow angle [rad] are, at line_doubt from where they meet.
constexpr double depth_doubt = 2e-6, line_doubt = 1e-5, narrow_angle = 0.25;
// Sine of the angle between ray and plane below which single precision may put the hit in any triangle of a patch.
constexpr double grazing = 1e-3;

// In each row the triangles that have its number among `numbers_of` them.
template <class PerTriangle, class NumbersOf>
Rows rows(std::size_t count, const PerTriangle& per_triangle, NumbersOf numbers_of) {
  Rows result{std::vector<std::uint32_t>(count + 1, 0), {}};
  for (const auto& of : per_triangle)
    for (const std::uint32_t row : numbers_of(of)) ++result.first[row + 1];
  for (std::size_t row = 1; row <= count; ++row) result.first[row] += result.first[row - 1];
  result.triangles.resize(result.first.back());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t t = 0; t < per_triangle.size(); ++t)
    for (const std::uint32_t row : numbers_of(per_triangle[t])) result.triangles[next[row]++] = t;
  return result;
}

}  // namespace

ExactHit::ExactHit(const TriangleMesh& mesh)
    : mesh_(mesh),
      // A point on the ray and a plane offset each carry a few roundings of numbers up to the radius.
      rounding_(8.0 * std::numeric_limits<double>::epsilon() * mesh.radius),
      doubt_(line_doubt * mesh.radius),
      touching_(mesh, depth_doubt * mesh.radius, narrow_angle),
      at_vertex_(rows(mesh.vertices.size(), mesh.triangles, std::identity())),
      of_patch_(rows(mesh.patches.size(), mesh.triangle_patch, [](std::uint32_t patch) { return std::array{patch}; })) {}

namespace {

// Volume spanned by a ray's direction and an edge (seen from the ray's origin): positive on one side of the edge, negative on the
// other, zero nowhere else than on it. Where rounding, at most `doubt`, could have decided, the sign is found exactly.
double edge_side(const Ray& ray, const dvec3& from, const dvec3& to, double doubt) {
  const double volume = glm::dot(ray.direction, glm::cross(from - ray.origin, to - ray.origin));
  return std::abs(volume) > doubt ? volume : doubt * exact_side(ray.direction, ray.origin, from, to);
}

bool same_sign(const std::array<double, 3>& s) {
  return (s[0] >= 0.0 && s[1] >= 0.0 && s[2] >= 0.0) || (s[0] <= 0.0 && s[1] <= 0.0 && s[2] <= 0.0);
}

}  // namespace

std::array<double, 3> ExactHit::edge_sides(const Ray& ray, std::uint32_t triangle) const {
  const auto& [i, j, k] = mesh_.triangles[triangle];
  const dvec3 &a = mesh_.vertices[i], &b = mesh_.vertices[j], &c = mesh_.vertices[k];
  // A dozen roundings of a product of two differences of numbers up to the radius and the origin's distance.
  const double longest = mesh_.radius + glm::length(ray.origin);
  const double doubt = 16.0 * std::numeric_limits<double>::epsilon() * longest * longest;
  return {edge_side(ray, a, b, doubt), edge_side(ray, b, c, doubt), edge_side(ray, c, a, doubt)};
}

bool ExactHit::contains(const Ray& ray, std::uint32_t triangle) const { return same_sign(edge_sides(ray, triangle)); }

bool ExactHit::is_inside(const Ray& ray, std::uint32_t triangle) const {
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

bool ExactHit::grazes(const Ray& ray, std::uint32_t patch) const {
  return std::abs(glm::dot(mesh_.patches[patch].normal, ray.direction)) < grazing;
}

void ExactHit::keep_nearer(const Ray& ray, std::uint32_t candidate, const IgnoredPatches& ignored_patches, Hit& nearest) const {
  const std::uint32_t of = patch(candidate);
  if (of == ray.source_patch || std::ranges::find(ignored_patches, of) != ignored_patches.end()) return;
  if (!ahead(ray, candidate) || !contains(ray, candidate)) return;
  const Hit hit{candidate, distance(ray, candidate)};
  const bool nearer =
      !nearest || hit.distance < nearest.distance || (hit.distance == nearest.distance && hit.triangle < nearest.triangle);
  if (nearer) nearest = hit;
}

Hit ExactHit::nearest_touching(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const {
  Hit nearest;
  keep_nearer(ray, triangle, ignored_patches, nearest);
  for (const std::uint32_t other : touching_[triangle]) keep_nearer(ray, other, ignored_patches, nearest);
  return nearest;
}

Hit ExactHit::nearest_around(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const {
  Hit nearest = nearest_touching(ray, triangle, ignored_patches);
  std::uint32_t scanned = no_index;
  for (const std::uint32_t vertex : mesh_.triangles[triangle])
    for (const std::uint32_t candidate : at_vertex_[vertex]) {
      keep_nearer(ray, candidate, ignored_patches, nearest);
      if (patch(candidate) == scanned || !grazes(ray, patch(candidate))) continue;
      scanned = patch(candidate);
      for (const std::uint32_t other : of_patch_[scanned]) keep_nearer(ray, other, ignored_patches, nearest);
    }
  return nearest;
}

bool ExactHit::from_behind(const Ray& ray, std::uint32_t triangle) const {
  return mesh_.closed(triangle) && glm::dot(mesh_.patches[patch(triangle)].normal, ray.direction) > 0.0;
}

Hit ExactHit::front_of(const Ray& ray, const Hit& hit, const IgnoredPatches& ignored_patches) const {
  const bool inside = ray.source_patch != no_index && glm::dot(mesh_.patches[ray.source_patch].normal, ray.direction) < 0.0;
  if (inside || !from_behind(ray, hit.triangle)) return hit;
  Hit front;
  for (const std::uint32_t vertex : mesh_.triangles[hit.triangle])
    for (const std::uint32_t candidate : at_vertex_[vertex])
      if (!from_behind(ray, candidate)) keep_nearer(ray, candidate, ignored_patches, front);
  if (!front) return hit;
  const double least = std::min(std::abs(glm::dot(mesh_.patches[patch(hit.triangle)].normal, ray.direction)),
                                std::abs(glm::dot(mesh_.patches[patch(front.triangle)].normal, ray.direction)));
  return (front.distance - hit.distance) * least <= 4.0 * flat_fraction * mesh_.radius ? front : hit;
}

}  // namespace raytube
