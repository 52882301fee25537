// Where a rigid body is.
#pragma once

#include "core/field.h"

namespace raytube {

using glm::dmat3;

/// Takes the points of a body from where they are at rest to where they are: r -> turn r + shift, in one frame.
struct Pose {
  dmat3 turn{1.0};   // a rotation
  dvec3 shift{0.0};  // [m]

  /// Of a point.
  dvec3 operator()(const dvec3& r) const { return turn * r + shift; }
  /// The pose on the right first.
  friend Pose operator*(const Pose& a, const Pose& b) { return {a.turn * b.turn, a.turn * b.shift + a.shift}; }
};

}  // namespace raytube
