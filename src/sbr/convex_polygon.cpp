#include "sbr/convex_polygon.h"

#include <algorithm>
#include <cmath>

namespace raytube {

double area(const ConvexPolygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const dvec2 a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

dvec2 middle(const ConvexPolygon& polygon) {
  dvec2 sum(0.0);
  for (const dvec2& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

Bounds bounds(const ConvexPolygon& polygon) {
  Bounds b{polygon[0], polygon[0]};
  for (const dvec2& p : polygon) {
    b.low = glm::min(b.low, p);
    b.high = glm::max(b.high, p);
  }
  return b;
}

Range range(const ConvexPolygon& polygon, const Affine& f) {
  Range r{f(polygon[0]), f(polygon[0])};
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const double value = f(polygon[i]);
    r.low = std::min(r.low, value);
    r.high = std::max(r.high, value);
  }
  return r;
}

Affine left_of(const dvec2& a, const dvec2& b) {
  const dvec2 along = b - a;
  const double length = glm::length(along);
  if (length == 0.0) return {};
  const dvec2 normal(-along.y / length, along.x / length);
  return {-glm::dot(normal, a), normal.x, normal.y};
}

namespace {

int side(double value, double tolerance) { return value > tolerance ? 1 : value < -tolerance ? -1 : 0; }

// Always from the positive end: the two polygons at an edge then find the same point.
dvec2 zero_between(const dvec2& p, double positive, const dvec2& q, double negative) {
  return p + (positive / (positive - negative)) * (q - p);
}

}  // namespace

void cut(const ConvexPolygon& polygon, const Affine& f, double tolerance, ConvexPolygon& positive, ConvexPolygon& negative) {
  positive.clear();
  negative.clear();
  bool any_positive = false, any_negative = false;
  dvec2 before = polygon.back();
  double value_before = f(before);
  int side_before = side(value_before, tolerance);
  for (const dvec2& here : polygon) {
    const double value = f(here);
    const int side_here = side(value, tolerance);
    if (side_before * side_here < 0) {
      const dvec2 crossing =
          side_here > 0 ? zero_between(here, value, before, value_before) : zero_between(before, value_before, here, value);
      positive.push_back(crossing);
      negative.push_back(crossing);
    }
    if (side_here >= 0) positive.push_back(here);
    if (side_here <= 0) negative.push_back(here);
    any_positive |= side_here > 0;
    any_negative |= side_here < 0;
    before = here;
    value_before = value;
    side_before = side_here;
  }
  if (!any_positive) positive.clear();
  if (!any_negative) negative.clear();
}

}  // namespace raytube
