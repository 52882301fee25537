// Polygons -> triangles.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/model/geometry.h"

namespace raytube {

/// The numbers of a polygon's corners.
using Ring = std::vector<std::uint32_t>;

/// A polygon in the coordinate plane its area is largest in, turned so that it runs counter-clockwise. Dropping a coordinate
/// rounds nothing.
class PlanarRing {
 public:
  PlanarRing(std::span<const dvec3> points, const Ring& ring) : points_(points) {
    dvec3 area(0.0);
    for (std::size_t i = 2; i < ring.size(); ++i) area += area_vector(points[ring[0]], points[ring[i - 1]], points[ring[i]]);
    const int dropped = longest_axis(glm::abs(area));
    u_ = (dropped + 1) % 3;
    v_ = (dropped + 2) % 3;
    if (area[dropped] < 0.0) std::swap(u_, v_);
  }

  dvec2 at(std::uint32_t p) const { return {points_[p][u_], points_[p][v_]}; }

  /// Twice the signed area of a triangle.
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const dvec2 ab = at(b) - at(a), ac = at(c) - at(a);
    return ab.x * ac.y - ab.y * ac.x;
  }

  /// The angle at a from b to c.
  double angle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const dvec2 ab = at(b) - at(a), ac = at(c) - at(a);
    return std::atan2(turn(a, b, c), ab.x * ac.x + ab.y * ac.y);
  }

  bool holds(const Triangle& t, std::uint32_t p) const {
    return turn(t[0], t[1], p) >= 0.0 && turn(t[1], t[2], p) >= 0.0 && turn(t[2], t[0], p) >= 0.0;
  }

 private:
  std::span<const dvec3> points_;
  int u_ = 0, v_ = 1;
};

/// Cuts ears one by one. A corner can be cut off when it is convex and no other corner lies in the triangle; those that the ring
/// passes twice (the bridge to a hole) are the triangle's own and do not count. The next ear is looked for from the second corner
/// after the last one: ears all round, not one long fan of slivers. A ring without an ear (it crosses itself, or is a line) loses
/// its next corner all the same, so that every polygon yields its full number of triangles.
std::vector<Triangle> cut_ears(const PlanarRing& plane, const Ring& ring);

/// Splits a polygon into corners - 2 triangles: a fan from the first corner where that covers it, ears otherwise. A corner
/// equal to the one before it is left out. Empty if fewer than three distinct corners are left.
std::vector<Triangle> triangulate(std::span<const dvec3> points, Ring polygon);

}  // namespace raytube
