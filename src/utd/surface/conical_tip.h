// A point about which a surface is a circular cone.
#pragma once

#include <cmath>

#include "core/field.h"

namespace raytube {

struct ConicalTip {
  dvec3 position, outwards;  // the axis, unit
  double half_angle;         // [rad]

  /// The radius of the cone at a point of it.
  double radius_at(const dvec3& point) const { return std::sin(half_angle) * glm::distance(position, point); }
};

}  // namespace raytube
