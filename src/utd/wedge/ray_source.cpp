#include "utd/wedge/ray_source.h"

#include <cmath>

namespace raytube {

Arrival arrival(const RaySource& source, const dvec3& point) {
  dvec3 ray = point - source.position;
  if (source.spreading == Spreading::plane) return {source.direction, glm::dot(source.direction, ray), 1.0};
  if (source.spreading == Spreading::line) ray -= glm::dot(ray, source.direction) * source.direction;
  const double length = glm::length(ray);
  return {ray / length, length, source.spreading == Spreading::line ? 1 / std::sqrt(length) : 1 / length};
}

ComplexVector free_field(const RaySource& source, const dvec3& point, double wavenumber) {
  const Arrival ray = arrival(source, point);
  return std::polar(ray.spread, -wavenumber * ray.path) * across(source.moment, ray.direction);
}

}  // namespace raytube
