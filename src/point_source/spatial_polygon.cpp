#include "point_source/spatial_polygon.h"

#include <cmath>

namespace raytube {

double area(const SpatialPolygon& polygon) {
  dvec3 twice(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * glm::length(twice);
}

dvec3 middle(const SpatialPolygon& polygon) {
  dvec3 sum(0.0);
  for (const dvec3& corner : polygon) sum += corner;
  return sum / static_cast<double>(polygon.size());
}

void cut(const SpatialPolygon& polygon, const HalfSpace& plane, double tolerance, SpatialPolygon& inside,
         SpatialPolygon& outside) {
  inside.clear();
  outside.clear();
  bool any_inside = false, any_outside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 &corner = polygon[i], &next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double here = plane(corner), there = plane(next);
    if (here >= -tolerance) inside.push_back(corner);
    if (here <= tolerance) outside.push_back(corner);
    any_inside |= here > tolerance;
    any_outside |= here < -tolerance;
    if ((here > tolerance && there < -tolerance) || (here < -tolerance && there > tolerance)) {
      const dvec3 crossing = corner + here / (here - there) * (next - corner);
      inside.push_back(crossing);
      outside.push_back(crossing);
    }
  }
  if (!any_inside) inside.clear();
  if (!any_outside) outside.clear();
}

double solid_angle(const dvec3& a, const dvec3& b, const dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double volume = glm::dot(a, glm::cross(b, c));
  const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
  return 2.0 * std::atan2(std::abs(volume), denominator);
}

double solid_angle(const SpatialPolygon& polygon, const dvec3& from) {
  double sum = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += solid_angle(polygon[0] - from, polygon[i - 1] - from, polygon[i] - from);
  return sum;
}

}  // namespace raytube
