#include "utd/shadow/triangle_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

// Six times the volume spanned by the ray from a point to the viewpoint and a side of a triangle.
double volume(const dvec3& ray, const dvec3& point, const dvec3& from, const dvec3& to) {
  return glm::dot(ray, glm::cross(from - point, to - point));
}

}  // namespace

TriangleShadow::TriangleShadow(const TriangleMesh& mesh, std::uint32_t triangle, const dvec3& start, const dvec3& end,
                               const Viewpoint& view) {
  const auto& corners = mesh.triangles[triangle];
  const Patch& plane = mesh.patch_of(triangle);
  const dvec3 first = view.towards_from(start), second = view.towards_from(end);
  const double facing = glm::dot(plane.normal, first), facing_end = glm::dot(plane.normal, second);
  const double rays = std::max(glm::length(first), glm::length(second));
  // Rounding decides which way a triangle faces that is seen more obliquely than by a sine of 1e-3.
  if (std::min(facing * std::copysign(1.0, facing_end), facing_end * std::copysign(1.0, facing)) < 1e-3 * rays) return;
  const double sign = std::copysign(1.0, facing);
  // As ExactHit allows for: a dozen roundings of products of numbers up to the radius and the point's distance.
  const double longest = mesh.radius + std::max(glm::length(start), glm::length(end));
  const double rounding = 32.0 * std::numeric_limits<double>::epsilon() * longest;
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const dvec3 &from = mesh.vertices[corners[k]], &to = mesh.vertices[corners[(k + 1) % 3]];
    above_zero_[k] = {volume(first, start, from, to), volume(second, end, from, to), rounding * longest * rays};
    sum += above_zero_[k].at_start;
  }
  for (int k = 0; k < 3; ++k) {
    above_zero_[k].at_start *= std::copysign(1.0, sum);
    above_zero_[k].at_end *= std::copysign(1.0, sum);
  }
  above_zero_[3] = {sign * (plane.offset - glm::dot(plane.normal, start)), sign * (plane.offset - glm::dot(plane.normal, end)),
                    rounding};
}

bool TriangleShadow::hides(double fraction) const {
  return std::ranges::all_of(above_zero_, [&](const Linear& f) { return f.at(fraction) > f.rounding; });
}

double TriangleShadow::end_towards(double other, double hidden) const {
  double end = std::copysign(std::numeric_limits<double>::infinity(), other - hidden);
  for (const Linear& f : above_zero_) {
    const double change = f.at_end - f.at_start;
    if (change * (other - hidden) >= 0.0) continue;
    const double root = -f.at_start / change;
    end = other > hidden ? std::min(end, root) : std::max(end, root);
  }
  return end;
}

}  // namespace raytube
