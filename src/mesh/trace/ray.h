// Rays and what they meet.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// A ray in recentred coordinates. A ray that leaves a surface names the patch it leaves: a straight ray cannot meet the
/// plane it starts on again, so that patch is never hit, however thin the gap to the next one.
struct Ray {
  dvec3 origin;                           // recentred coordinates [m]
  dvec3 direction;                        // unit
  std::uint32_t source_patch = no_index;  // that it leaves; no_index: none
};

/// Whether a ray has a place and a direction at all.
inline bool is_finite(const Ray& ray) {
  return std::isfinite(ray.origin.x + ray.origin.y + ray.origin.z + ray.direction.x + ray.direction.y + ray.direction.z);
}

/// The surface a ray meets; false if there is none.
struct Hit {
  std::uint32_t triangle = no_index;  // that it meets
  double distance = 0.0;              // along the ray [m], to the plane of the triangle's patch
  bool from_inside = false;           // whether it meets a closed body from inside: a ray that comes from outside has slipped in
  /// Whether there is one.
  explicit operator bool() const { return triangle != no_index; }
};

/// Patches that a query leaves out; no_index fills the rest.
using IgnoredPatches = std::array<std::uint32_t, 3>;
/// Leaves out none.
inline constexpr IgnoredPatches nothing_ignored{no_index, no_index, no_index};

/// Rays through the cells of a grid pass so far beside the middles of these, in cells, that they never run exactly along edges
/// of a mesh.
inline constexpr double beside_u = 0.01 * (std::numbers::sqrt2 - 1.0);
inline constexpr double beside_v = 0.01 * (std::numbers::sqrt3 - 1.0);  // the same along v

}  // namespace raytube
