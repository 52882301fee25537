// Convex polygons of the launch plane and the one operation on them: a cut along a line.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

/// c + u x + v y: a line (where it is zero) or a depth.
struct Affine {
  double c = 0.0, u = 0.0, v = 0.0;
  double operator()(const dvec2& at) const { return c + u * at.x + v * at.y; }
  friend Affine operator-(const Affine& a, const Affine& b) { return {a.c - b.c, a.u - b.u, a.v - b.v}; }
};

/// A corner and the edge from it to the next one, as the distance to its line, positive inside. Edges keep the line they were cut
/// along, however short they become: two corners a rounding apart say nothing about it.
struct Corner {
  dvec2 at;
  Affine edge;
};

/// Corners counter-clockwise; fewer than three: nothing.
using ConvexPolygon = std::vector<Corner>;

/// The line f = 0 as the distance to it.
Affine normalized(const Affine& f);

struct Bounds {
  dvec2 low, high;
  bool overlaps(const Bounds& other, double margin) const {
    return low.x < other.high.x - margin && other.low.x < high.x - margin && low.y < other.high.y - margin &&
           other.low.y < high.y - margin;
  }
};

struct Range {
  double low, high;
  bool empty() const { return low > high; }
};

inline dvec2 middle(const Bounds& box) { return 0.5 * (box.low + box.high); }
inline double area(const Bounds& box) { return (box.high.x - box.low.x) * (box.high.y - box.low.y); }
double area(const ConvexPolygon& polygon);   // negative if clockwise
dvec2 middle(const ConvexPolygon& polygon);  // mean of the corners, which lies inside
Bounds bounds(const ConvexPolygon& polygon);
inline Bounds common(const Bounds& a, const Bounds& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }
inline Range range(const ConvexPolygon& polygon, const Affine& f) {
  Range r{f(polygon[0].at), f(polygon[0].at)};
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const double value = f(polygon[i].at);
    r.low = std::min(r.low, value);
    r.high = std::max(r.high, value);
  }
  return r;
}
Range range(const Bounds& box, const Affine& f);
/// Whether f exceeds `value` somewhere in the polygon.
inline bool reaches_beyond(const ConvexPolygon& polygon, const Affine& f, double value) {
  return std::ranges::any_of(polygon, [&](const Corner& corner) { return f(corner.at) > value; });
}

/// The part [low, high] of the way from `a` to `b` that lies in the box.
Range part_within(const Bounds& box, const dvec2& a, const dvec2& b);

/// A box as a polygon.
ConvexPolygon rectangle(const Bounds& box);

/// The polygon of these corners, in whichever sense they run.
void set_corners(ConvexPolygon& polygon, std::span<const dvec2> corners);

/// c + x u + y v: from one plane to another.
struct AffineMap {
  dvec2 c, u, v;
  dvec2 operator()(const dvec2& at) const { return c + at.x * u + at.y * v; }
};

/// Area of the image over that of the original, below zero if it is mirrored.
inline double stretch(const AffineMap& map) { return map.u.x * map.v.y - map.u.y * map.v.x; }
AffineMap inverse(const AffineMap& map);
/// `there` maps the polygon's plane, `back` is its inverse.
ConvexPolygon image(const ConvexPolygon& polygon, const AffineMap& there, const AffineMap& back);

/// What two polygons have in common; empty if nothing.
ConvexPolygon intersection(ConvexPolygon polygon, const ConvexPolygon& other);

/// Cuts along f = 0, which is no distance as a rule. A corner with |f| <= tolerance lies on the cut and belongs to both parts; a
/// part without a corner beyond that is left empty. The two parts share the new corners, so their areas add up.
void cut(const ConvexPolygon& polygon, const Affine& f, double tolerance, ConvexPolygon& positive, ConvexPolygon& negative);
/// The positive part alone.
void clip(const ConvexPolygon& polygon, const Affine& f, double tolerance, ConvexPolygon& positive);

}  // namespace raytube
