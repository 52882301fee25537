#include "mesh/triangulate.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

using Ring = std::vector<std::uint32_t>;

void drop_repeated_corners(Ring& ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

bool has_three_distinct(Ring ring) {
  std::sort(ring.begin(), ring.end());
  return std::unique(ring.begin(), ring.end()) - ring.begin() >= 3;
}

std::vector<Triangle> fan(const Ring& ring) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 2; i < ring.size(); ++i) triangles.push_back({ring[0], ring[i - 1], ring[i]});
  return triangles;
}

/// A polygon in the coordinate plane its area is largest in, turned so that it runs counter-clockwise. Dropping a coordinate
/// rounds nothing.
class PlanarRing {
 public:
  PlanarRing(std::span<const dvec3> points, const Ring& ring) : points_(points) {
    dvec3 area(0.0);
    for (std::size_t i = 2; i < ring.size(); ++i) area += area_vector(points[ring[0]], points[ring[i - 1]], points[ring[i]]);
    const dvec3 size = glm::abs(area);
    const int dropped = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    u_ = (dropped + 1) % 3;
    v_ = (dropped + 2) % 3;
    if (area[dropped] < 0.0) std::swap(u_, v_);
  }

  /// Twice the signed area of a triangle.
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const dvec3 ab = points_[b] - points_[a], ac = points_[c] - points_[a];
    return ab[u_] * ac[v_] - ab[v_] * ac[u_];
  }

  /// The angle at a from b to c.
  double angle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const dvec3 ab = points_[b] - points_[a], ac = points_[c] - points_[a];
    return std::atan2(turn(a, b, c), ab[u_] * ac[u_] + ab[v_] * ac[v_]);
  }

  bool holds(const Triangle& t, std::uint32_t p) const {
    return turn(t[0], t[1], p) >= 0.0 && turn(t[1], t[2], p) >= 0.0 && turn(t[2], t[0], p) >= 0.0;
  }

 private:
  std::span<const dvec3> points_;
  int u_ = 0, v_ = 1;
};

/// Every triangle of the fan has the polygon's own sense of rotation and is no sliver: true for convex polygons without
/// corners on their sides, and for some others.
bool fan_covers(const PlanarRing& plane, const Ring& ring) {
  for (std::size_t i = 2; i < ring.size(); ++i)
    if (plane.angle(ring[0], ring[i - 1], ring[i]) < 1e-6) return false;
  return true;
}

Triangle ear_at(const Ring& ring, std::size_t i) {
  return {ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]};
}

/// A corner can be cut off when it is convex and no other corner lies in the triangle. Corners that the ring passes twice
/// (the bridge to a hole) are the triangle's own and do not count.
bool is_ear(const PlanarRing& plane, const Ring& ring, std::size_t i) {
  const Triangle ear = ear_at(ring, i);
  if (!(plane.turn(ear[0], ear[1], ear[2]) > 0.0)) return false;
  return std::none_of(ring.begin(), ring.end(),
                      [&](std::uint32_t p) { return std::find(ear.begin(), ear.end(), p) == ear.end() && plane.holds(ear, p); });
}

/// Cuts ears one by one. A ring without an ear (it crosses itself, or is a line) loses its next corner all the same, so that
/// every polygon yields its full number of triangles.
std::vector<Triangle> cut_ears(const PlanarRing& plane, Ring ring) {
  std::vector<Triangle> triangles;
  std::size_t i = 0;
  while (ring.size() > 3) {
    std::size_t tried = 0;
    while (tried < ring.size() && !is_ear(plane, ring, (i + tried) % ring.size())) ++tried;
    i = (i + tried) % ring.size();
    triangles.push_back(ear_at(ring, i));
    ring.erase(ring.begin() + i);
    i = (i + 1) % ring.size();  // ears all round, not one long fan of slivers
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const dvec3> points, std::vector<std::uint32_t> polygon) {
  drop_repeated_corners(polygon);
  if (!has_three_distinct(polygon)) return {};
  if (polygon.size() == 3) return {{polygon[0], polygon[1], polygon[2]}};
  const PlanarRing plane(points, polygon);
  return fan_covers(plane, polygon) ? fan(polygon) : cut_ears(plane, std::move(polygon));
}

}  // namespace raytube
