// Where a wave that has come over edges and surfaces has its place.
#pragma once

#include "core/field.h"

namespace raytube {

/// The place of waves that come back to where they came from. A path that light begins at one point and that ends at another, and
/// whose length is stationary at all between, changes with the direction as 2 k times the middle of both: the place lies there
/// across, and where the path says along the line of sight. Light that comes over mirrors begins at the image in these.
struct PathPlace {
  dvec3 towards;         // the radar
  glm::dmat3 turn{1.0};  // a point's image is turn point + shift
  dvec3 shift{0.0};      // [m]
  double path = 0.0;     // what `phase` leaves out of the light's path [m]

  /// `phase`: exponent / k of what radiates from `last` [m].
  dvec3 at(const dvec3& first, const dvec3& last, double phase) const {
    const dvec3 middle = 0.5 * (turn * first + shift + last);
    return middle + (0.5 * (phase - path) - glm::dot(towards, middle)) * towards;
  }

  /// With one mirror more before the light begins.
  void add_mirror(const dvec3& normal, double offset) {
    const glm::dmat3 mirror = glm::dmat3(1.0) - 2.0 * glm::outerProduct(normal, normal);
    turn = turn * mirror;
    shift += turn * (-2.0 * offset * normal);
  }
};

}  // namespace raytube
