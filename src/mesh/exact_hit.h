// Double-precision decisions about one ray and one triangle, and the neighbours a ray near an edge may have met instead.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/tracer.h"

namespace raytube {

class ExactHit {
 public:
  explicit ExactHit(const TriangleMesh& mesh);

  std::uint32_t patch(std::uint32_t triangle) const { return mesh_.triangle_patch[triangle]; }

  /// Distance along the ray to the plane of the triangle's patch.
  double distance(const Ray& ray, std::uint32_t triangle) const {
    const Patch& plane = mesh_.patches[patch(triangle)];
    return (plane.offset - glm::dot(plane.normal, ray.origin)) / glm::dot(plane.normal, ray.direction);
  }

  /// True if that plane lies ahead of the ray's start by more than the rounding of the two.
  bool ahead(const Ray& ray, std::uint32_t triangle) const {
    const Patch& plane = mesh_.patches[patch(triangle)];
    const double height = plane.offset - glm::dot(plane.normal, ray.origin);
    return std::abs(height) > rounding_ && height * glm::dot(plane.normal, ray.direction) > 0.0;
  }

  /// True if the ray's line runs through the triangle, rim included. Two triangles that share an edge decide about it with
  /// exactly opposite numbers, so no ray slips between them.
  bool contains(const Ray& ray, std::uint32_t triangle) const;

  /// True if single precision cannot have mistaken this hit: the ray passes well inside all three edges, and no other surface
  /// lies on the triangle or so close to it that their order is in doubt.
  bool is_safe(const Ray& ray, std::uint32_t triangle) const;

  /// A hit whose three edge functions - volumes spanned by the ray's direction and an edge [m^2] - are all above this in single
  /// precision is safe in double: twice the doubt on the longest edge. Infinite where is_safe() is never true.
  double safe_side(std::uint32_t triangle) const;

  /// False if the ray's line certainly passes the triangle by, told from its bounding ball alone.
  bool may_contain(const Ray& ray, std::uint32_t triangle) const {
    const Ball& ball = balls_[triangle];
    const dvec3 to_middle = dvec3(ball.middle) - ray.origin;
    const double along = glm::dot(to_middle, ray.direction);
    return glm::dot(to_middle, to_middle) - along * along <= double{ball.radius} * ball.radius;
  }

  /// The distance along the ray [m] within which single precision may have put surfaces in the wrong order.
  double depth_doubt(const Ray& ray, std::uint32_t triangle) const;
  bool is_stacked(std::uint32_t triangle) const { return stacked_[triangle]; }

  /// The nearest triangle that contains the ray, among `triangle` and those sharing a corner with it but not on
  /// an ignored patch; ties to the lower index.
  Hit nearest_around(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const;

 private:
  // In single precision, which halves the memory to be read; the radius makes up for that.
  struct Ball {
    glm::vec3 middle;
    float radius;
  };

  Ball ball(std::uint32_t triangle) const;
  std::array<double, 3> edge_sides(const Ray& ray, std::uint32_t triangle) const;
  std::span<const std::uint32_t> around(std::uint32_t vertex) const;

  const TriangleMesh& mesh_;
  double rounding_;
  double doubt_;
  std::vector<bool> stacked_;
  std::vector<Ball> balls_;
  std::vector<std::uint32_t> first_, incident_;  // triangles at each vertex, compressed rows
};

}  // namespace raytube
