#include "mesh/repair/triangulate.h"

#include <algorithm>

#include "mesh/repair/ears.h"

namespace raytube {

namespace {

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

/// Every triangle of the fan has the polygon's own sense of rotation and is no sliver: true for convex polygons without
/// corners on their sides, and for some others.
bool fan_covers(const PlanarRing& plane, const Ring& ring) {
  for (std::size_t i = 2; i < ring.size(); ++i)
    if (plane.angle(ring[0], ring[i - 1], ring[i]) < 1e-6) return false;
  return true;
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const dvec3> points, std::vector<std::uint32_t> polygon) {
  drop_repeated_corners(polygon);
  if (!has_three_distinct(polygon)) return {};
  if (polygon.size() == 3) return {{polygon[0], polygon[1], polygon[2]}};
  const PlanarRing plane(points, polygon);
  return fan_covers(plane, polygon) ? fan(polygon) : cut_ears(plane, polygon);
}

}  // namespace raytube
