#include "mesh/exact_hit.h"

#include <algorithm>
#include <functional>
#include <limits>

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

}  // namespace raytube
