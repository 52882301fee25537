#include "sbr/launch/convex_polygon.h"

#include <algorithm>
#include <cmath>

namespace raytube {

Affine normalized(const Affine& f) {
  const double scale = 1.0 / std::sqrt(f.u * f.u + f.v * f.v);
  return {scale * f.c, scale * f.u, scale * f.v};
}

double area(const ConvexPolygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const dvec2 a = polygon[i - 1].at - polygon[0].at, b = polygon[i].at - polygon[0].at;
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

dvec2 middle(const ConvexPolygon& polygon) {
  dvec2 sum(0.0);
  for (const Corner& corner : polygon) sum += corner.at;
  return sum / static_cast<double>(polygon.size());
}

Bounds bounds(const ConvexPolygon& polygon) {
  Bounds b{polygon[0].at, polygon[0].at};
  for (const Corner& corner : polygon) {
    b.low = glm::min(b.low, corner.at);
    b.high = glm::max(b.high, corner.at);
  }
  return b;
}

AffineMap inverse(const AffineMap& map) {
  const double scale = 1.0 / stretch(map);
  const dvec2 u = scale * dvec2(map.v.y, -map.u.y), v = scale * dvec2(-map.v.x, map.u.x);
  return {-(map.c.x * u + map.c.y * v), u, v};
}

ConvexPolygon image(const ConvexPolygon& polygon, const AffineMap& there, const AffineMap& back) {
  const auto line = [&](const Affine& f) {
    return normalized({f(back.c), f.u * back.u.x + f.v * back.u.y, f.u * back.v.x + f.v * back.v.y});
  };
  ConvexPolygon result;
  for (const Corner& corner : polygon) result.push_back({there(corner.at), line(corner.edge)});
  if (stretch(there) > 0.0) return result;
  for (std::size_t i = 0; i < polygon.size(); ++i) result[i].edge = line(polygon[(i + polygon.size() - 1) % polygon.size()].edge);
  std::ranges::reverse(result);
  return result;
}

Range range(const Bounds& box, const Affine& f) {
  const double across_u = f.u * (box.high.x - box.low.x), across_v = f.v * (box.high.y - box.low.y), corner = f(box.low);
  return {corner + std::min(across_u, 0.0) + std::min(across_v, 0.0), corner + std::max(across_u, 0.0) + std::max(across_v, 0.0)};
}

namespace {

// Distance to the line from `a` to `b`, positive on its left.
Affine left_of(const dvec2& a, const dvec2& b) {
  const dvec2 along = b - a;
  const double length = glm::length(along);
  if (length == 0.0) return {1.0, 0.0, 0.0};
  const dvec2 normal(-along.y / length, along.x / length);
  return {-glm::dot(normal, a), normal.x, normal.y};
}

int side(double value, double tolerance) { return value > tolerance ? 1 : value < -tolerance ? -1 : 0; }

// Always from the positive end: the two polygons at an edge then find the same point.
dvec2 zero_between(const dvec2& p, double positive, const dvec2& q, double negative) {
  return p + (positive / (positive - negative)) * (q - p);
}

// The part of a polygon where f has this sign. Where it leaves the polygon's outline, it goes on along the cut.
void set_part(const ConvexPolygon& polygon, const Affine& f, double tolerance, int sign, ConvexPolygon& part) {
  part.clear();
  const Affine inward = normalized(sign > 0 ? f : Affine{-f.c, -f.u, -f.v});
  bool any = false;
  double value = f(polygon[0].at);
  int here = sign * side(value, tolerance);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& corner = polygon[i];
    const Corner& next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double value_next = f(next.at);
    const int there = sign * side(value_next, tolerance);
    if (here >= 0) part.push_back({corner.at, here == 0 && there < 0 ? inward : corner.edge});
    if (here * there < 0) {
      const dvec2 crossing =
          value > 0.0 ? zero_between(corner.at, value, next.at, value_next) : zero_between(next.at, value_next, corner.at, value);
      part.push_back({crossing, here > 0 ? inward : corner.edge});
    }
    any |= here > 0;
    value = value_next;
    here = there;
  }
  if (!any) part.clear();
}

}  // namespace

Range part_within(const Bounds& box, const dvec2& a, const dvec2& b) {
  Range part{0.0, 1.0};
  for (int axis = 0; axis < 2; ++axis) {
    const double way = b[axis] - a[axis];
    if (way == 0.0) {
      if (a[axis] < box.low[axis] || a[axis] > box.high[axis]) return {1.0, 0.0};
      continue;
    }
    const double to_low = (box.low[axis] - a[axis]) / way, to_high = (box.high[axis] - a[axis]) / way;
    part = {std::max(part.low, std::min(to_low, to_high)), std::min(part.high, std::max(to_low, to_high))};
  }
  return part;
}

ConvexPolygon rectangle(const Bounds& box) {
  ConvexPolygon polygon;
  set_corners(polygon, std::array{box.low, dvec2(box.high.x, box.low.y), box.high, dvec2(box.low.x, box.high.y)});
  return polygon;
}

void set_corners(ConvexPolygon& polygon, std::span<const dvec2> corners) {
  polygon.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) polygon[i].at = corners[i];
  if (area(polygon) < 0.0) std::ranges::reverse(polygon);
  for (std::size_t i = 0; i < polygon.size(); ++i)
    polygon[i].edge = left_of(polygon[i].at, polygon[i + 1 < polygon.size() ? i + 1 : 0].at);
}

ConvexPolygon intersection(ConvexPolygon polygon, const ConvexPolygon& other) {
  ConvexPolygon inside, outside;
  for (const Corner& corner : other) {
    if (polygon.empty()) break;
    cut(polygon, corner.edge, 0.0, inside, outside);
    std::swap(polygon, inside);
  }
  return polygon;
}

void cut(const ConvexPolygon& polygon, const Affine& f, double tolerance, ConvexPolygon& positive, ConvexPolygon& negative) {
  set_part(polygon, f, tolerance, 1, positive);
  set_part(polygon, f, tolerance, -1, negative);
}

void clip(const ConvexPolygon& polygon, const Affine& f, double tolerance, ConvexPolygon& positive) {
  set_part(polygon, f, tolerance, 1, positive);
}

}  // namespace raytube
