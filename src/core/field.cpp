#include "core/field.h"

#include <cmath>

namespace raytube {

namespace {

// sin and cos of a multiple of a right angle, rounded to double, miss 0 by up to 1.3e-16 per turn; such a component is zero.
double without_dust(double component) { return std::abs(component) < 1e-15 ? 0.0 : component; }

}  // namespace

SphericalBasis spherical_basis(const Direction& direction) {
  const double sin_theta = without_dust(std::sin(direction.theta)), cos_theta = without_dust(std::cos(direction.theta));
  const double sin_phi = without_dust(std::sin(direction.phi)), cos_phi = without_dust(std::cos(direction.phi));
  return {{sin_theta * cos_phi, sin_theta * sin_phi, cos_theta},
          {cos_theta * cos_phi, cos_theta * sin_phi, -sin_theta},
          {-sin_phi, cos_phi, 0.0}};
}

Direction direction_of(const dvec3& point) {
  return {std::atan2(std::hypot(point.x, point.y), point.z), std::atan2(point.y, point.x)};
}

}  // namespace raytube
