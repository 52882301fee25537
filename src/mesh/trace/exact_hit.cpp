#include "mesh/trace/exact_hit.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

#include "math/exact_sign.h"
#include "mesh/model/geometry.h"

namespace raytube {

namespace {

// In radii of the mesh. Float coordinates of size one round by 6e-8; origin, vertices and edge functions add up to ten of that,
// and the largest displacement of a hit found in tests is 1e-6. Two surfaces that far apart are told from one another; two that
// open by the narrow angle [rad] are, at line_uncertainty from where they meet.
constexpr double depth_uncertainty = 2e-6, line_uncertainty = 1e-5, narrow_angle = 0.25;
// Sine of the angle between ray and plane below which single precision may put the hit in any triangle of a patch.
constexpr double grazing = 1e-3;

}  // namespace

double ExactHit::edge_uncertainty(const TriangleMesh& mesh) { return line_uncertainty * mesh.radius; }

ExactHit::ExactHit(const TriangleMesh& mesh, std::size_t longest_list)
    : mesh_(mesh),
      longest_list_(longest_list),
      // A point on the ray and a plane offset each carry a few roundings of numbers up to the radius.
      rounding_(8.0 * std::numeric_limits<double>::epsilon() * mesh.radius),
      edge_uncertainty_(edge_uncertainty(mesh)),
      // Facets of either patch are off its plane by a fraction of the diagonal, which is at most 2 sqrt(3) times the radius.
      plane_uncertainty_(2.0 * flat_fraction * 2.0 * std::numbers::sqrt3 * mesh.radius),
      tree_(mesh),
      at_vertex_(mesh.at_vertex()),
      of_patch_(mesh.of_patch()),
      near_coincident_(mesh, tree_, depth_uncertainty * mesh.radius, narrow_angle) {
  for (std::uint32_t vertex = 0; vertex < at_vertex_.size(); ++vertex) {
    if (!is_long(at_vertex_[vertex])) continue;
    std::vector<std::uint32_t>& patches = patches_at_[vertex];
    for (const std::uint32_t triangle : at_vertex_[vertex]) patches.push_back(patch(triangle));
    std::ranges::sort(patches);
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  }
}

namespace {

// Volume spanned by a ray's direction and the two ends of an edge, from the ray's origin: positive on one side of the edge,
// negative on the other, zero nowhere else than on it. Where rounding, at most `rounding`, could have decided, the sign is found
// exactly.
double edge_side(const Ray& ray, const dvec3& from, const dvec3& to, double rounding) {
  const double volume = glm::dot(ray.direction, glm::cross(from - ray.origin, to - ray.origin));
  return std::abs(volume) > rounding ? volume : rounding * exact_side(ray.direction, ray.origin, from, to);
}

bool is_ignored(const Ray& ray, std::uint32_t patch, const IgnoredPatches& ignored_patches) {
  return patch == ray.source_patch || std::ranges::find(ignored_patches, patch) != ignored_patches.end();
}

bool same_sign(const std::array<double, 3>& s) {
  return (s[0] >= 0.0 && s[1] >= 0.0 && s[2] >= 0.0) || (s[0] <= 0.0 && s[1] <= 0.0 && s[2] <= 0.0);
}

}  // namespace

std::array<double, 3> ExactHit::edge_sides(const Ray& ray, std::uint32_t triangle) const {
  const auto [a, b, c] = mesh_.corners(triangle);
  // A dozen roundings of a product of two differences of numbers up to the radius and the origin's distance.
  const double longest = mesh_.radius + glm::length(ray.origin);
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * longest * longest;
  return {edge_side(ray, a, b, rounding), edge_side(ray, b, c, rounding), edge_side(ray, c, a, rounding)};
}

bool ExactHit::contains(const Ray& ray, std::uint32_t triangle) const { return same_sign(edge_sides(ray, triangle)); }

bool ExactHit::is_inside(const Ray& ray, std::uint32_t triangle) const {
  const std::array<double, 3> sides = edge_sides(ray, triangle);
  if (!same_sign(sides)) return false;
  const auto [a, b, c] = mesh_.corners(triangle);
  const dvec3 edges[3] = {b - a, c - b, a - c};
  // Side over edge length is at most the distance between the two lines.
  for (int e = 0; e < 3; ++e)
    if (sides[e] * sides[e] < edge_uncertainty_ * edge_uncertainty_ * glm::dot(edges[e], edges[e])) return false;
  return true;
}

bool ExactHit::grazes(const Ray& ray, std::uint32_t patch) const {
  return std::abs(glm::dot(mesh_.patches[patch].normal, ray.direction)) < grazing;
}

double ExactHit::depth(const Ray& ray, std::uint32_t triangle) const { return depth(ray, triangle, edge_sides(ray, triangle)); }

// The plane of a patch is not quite that of the triangle: where a ray grazes the two, it meets them far apart. The sides are
// those of the triangle, each as the share of the corner opposite to it.
double ExactHit::depth(const Ray& ray, std::uint32_t triangle, const std::array<double, 3>& sides) const {
  const double sum = sides[0] + sides[1] + sides[2];
  if (!grazes(ray, patch(triangle)) || sum == 0.0) return distance(ray, triangle);
  double depth = 0.0;
  for (int k = 0; k < 3; ++k)
    depth += sides[k] / sum * glm::dot(mesh_.vertices[mesh_.triangles[triangle][(k + 2) % 3]] - ray.origin, ray.direction);
  return depth;
}

void ExactHit::keep_nearer(const Ray& ray, std::uint32_t candidate, const IgnoredPatches& ignored_patches, Hit& nearest) const {
  if (is_ignored(ray, patch(candidate), ignored_patches)) return;
  if (!ahead(ray, candidate)) return;
  const std::array<double, 3> sides = edge_sides(ray, candidate);
  if (!same_sign(sides)) return;
  const Hit hit{candidate, depth(ray, candidate, sides)};
  if (hit.distance < -edge_uncertainty_) return;  // only its patch's plane lies ahead
  const bool nearer =
      !nearest || hit.distance < nearest.distance || (hit.distance == nearest.distance && hit.triangle < nearest.triangle);
  if (nearer) nearest = hit;
}

// keep_nearer() with all triangles that the ray's line meets, if acceptable.
template <class Accept>
void ExactHit::keep_nearer_of_all(const Ray& ray, const IgnoredPatches& ignored_patches, Hit& nearest, Accept accept) const {
  std::vector<std::uint32_t> candidates;
  tree_.near_line(ray.origin, ray.direction, candidates);
  for (const std::uint32_t candidate : candidates)
    if (accept(candidate)) keep_nearer(ray, candidate, ignored_patches, nearest);
}

// The same with those of an ascending list.
template <class Accept>
void ExactHit::keep_nearer_of(std::span<const std::uint32_t> list, const Ray& ray, const IgnoredPatches& ignored_patches,
                              Hit& nearest, Accept accept) const {
  if (is_long(list))
    keep_nearer_of_all(ray, ignored_patches, nearest,
                       [&](std::uint32_t candidate) { return std::ranges::binary_search(list, candidate) && accept(candidate); });
  else
    for (const std::uint32_t candidate : list)
      if (accept(candidate)) keep_nearer(ray, candidate, ignored_patches, nearest);
}

bool ExactHit::has_long_corner(std::uint32_t triangle) const {
  return std::ranges::any_of(mesh_.triangles[triangle], [&](std::uint32_t vertex) { return is_long(at_vertex_[vertex]); });
}

bool ExactHit::has_corner_on(std::uint32_t triangle, std::uint32_t of) const {
  return std::ranges::any_of(mesh_.triangles[triangle], [&](std::uint32_t vertex) {
    if (is_long(at_vertex_[vertex])) return std::ranges::binary_search(patches_at_.at(vertex), of);
    return std::ranges::any_of(at_vertex_[vertex], [&](std::uint32_t other) { return patch(other) == of; });
  });
}

// A ray along a patch with near-coincident facets may have met it before, farther away than these.
Hit ExactHit::nearest_near_coincident(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const {
  const std::span<const std::uint32_t> others = near_coincident_[triangle], patches = near_coincident_.patches(triangle);
  Hit nearest;
  keep_nearer(ray, triangle, ignored_patches, nearest);
  const dvec3 point = ray.origin + distance(ray, triangle) * ray.direction;
  const auto runs_along = [&](std::uint32_t of) {
    const Patch& plane = mesh_.patches[of];
    return std::abs(plane.height(point)) < edge_uncertainty_ && std::abs(glm::dot(plane.normal, ray.direction)) < narrow_angle;
  };
  if (is_long(others)) {
    keep_nearer_of_all(ray, ignored_patches, nearest, [&](std::uint32_t other) {
      return std::ranges::binary_search(others, other) ||
             (runs_along(patch(other)) && std::ranges::binary_search(patches, patch(other)));
    });
    return nearest;
  }
  for (const std::uint32_t other : others) keep_nearer(ray, other, ignored_patches, nearest);
  for (const std::uint32_t of : patches)
    if (runs_along(of)) keep_nearer_of_patch(ray, of, ignored_patches, nearest);
  return nearest;
}

Hit ExactHit::nearest_around(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const {
  Hit nearest = nearest_near_coincident(ray, triangle, ignored_patches);
  if (has_long_corner(triangle)) {
    keep_nearer_of_all(ray, ignored_patches, nearest, [&](std::uint32_t other) {
      return share_corner(mesh_.triangles[triangle], mesh_.triangles[other]) ||
             (grazes(ray, patch(other)) && has_corner_on(triangle, patch(other)));
    });
    return nearest;
  }
  std::vector<std::uint32_t> scanned;
  for (const std::uint32_t vertex : mesh_.triangles[triangle])
    for (const std::uint32_t candidate : at_vertex_[vertex]) {
      keep_nearer(ray, candidate, ignored_patches, nearest);
      const std::uint32_t of = patch(candidate);
      if (!grazes(ray, of) || std::ranges::find(scanned, of) != scanned.end()) continue;
      scanned.push_back(of);
      keep_nearer_of_patch(ray, of, ignored_patches, nearest);
    }
  return nearest;
}

// True if the ray's line keeps away from the plane of a patch wherever the target is.
bool ExactHit::stays_off(const Ray& ray, std::uint32_t patch) const {
  const Patch& plane = mesh_.patches[patch];
  const dvec3 middle = ray.origin - glm::dot(ray.origin, ray.direction) * ray.direction;
  const double height = std::abs(plane.offset - glm::dot(plane.normal, middle));
  return height > std::abs(glm::dot(plane.normal, ray.direction)) * mesh_.radius + edge_uncertainty_;
}

void ExactHit::keep_nearer_of_patch(const Ray& ray, std::uint32_t grazed, const IgnoredPatches& ignored_patches,
                                    Hit& nearest) const {
  if (is_ignored(ray, grazed, ignored_patches) || !plane_ahead(ray, grazed) || stays_off(ray, grazed)) return;
  keep_nearer_of(of_patch_[grazed], ray, ignored_patches, nearest, [](std::uint32_t) { return true; });
}

// Into the closed body whose surface it leaves.
bool ExactHit::leaves_inwards(const Ray& ray) const {
  if (ray.source_patch == no_index || !mesh_.closed(of_patch_[ray.source_patch].front())) return false;
  return glm::dot(mesh_.patches[ray.source_patch].normal, ray.direction) < 0.0;
}

// How far along the way on which a ray came its start may be off the facet [m].
double ExactHit::start_uncertainty(const Ray& ray) const {
  const double leaving = std::abs(glm::dot(mesh_.patches[ray.source_patch].normal, ray.direction));
  return plane_uncertainty_ / std::max(leaving, grazing);
}

bool ExactHit::begins_beneath(const Ray& ray, std::uint32_t triangle) const {
  const Patch& plane = mesh_.patches[patch(triangle)];
  return plane.offset - glm::dot(plane.normal, ray.origin) <= start_uncertainty(ray);
}

Ray ExactHit::moved_back(const Ray& ray) const {
  const dvec3& normal = mesh_.patches[ray.source_patch].normal;
  const dvec3 incoming = ray.direction - 2.0 * glm::dot(normal, ray.direction) * normal;
  return {ray.origin - start_uncertainty(ray) * incoming, ray.direction, ray.source_patch};
}

Hit ExactHit::front_of(const Ray& ray, const Hit& hit, const IgnoredPatches& ignored_patches) const {
  if (!hit || !is_lost(ray, hit.triangle)) return hit;
  Hit front;
  const auto is_front = [&](std::uint32_t candidate) { return !meets_from_inside(ray, candidate); };
  for (const std::uint32_t vertex : mesh_.triangles[hit.triangle])
    keep_nearer_of(at_vertex_[vertex], ray, ignored_patches, front, is_front);
  keep_nearer_of(near_coincident_[hit.triangle], ray, ignored_patches, front, is_front);
  if (!front) return hit;
  const double least = std::min(std::abs(glm::dot(mesh_.patches[patch(hit.triangle)].normal, ray.direction)),
                                std::abs(glm::dot(mesh_.patches[patch(front.triangle)].normal, ray.direction)));
  return (front.distance - hit.distance) * least <= plane_uncertainty_ ? front : hit;
}

}  // namespace raytube
