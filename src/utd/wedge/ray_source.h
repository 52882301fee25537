// Sources at any distance and the field they have in free space.
#pragma once

#include "core/complex_vector.h"

namespace raytube {

/// The form of the waves of a source.
enum class Spreading {
  plane,  // all along one direction
  line,   // from a straight line
  point   // from a point
};

/// Far from it the free field of a source of moment p is (p - d (d.p)) spread e^{-jk path}, d the ray's direction:
///   point  spread 1/r, path r: the waves of a short dipole, p in volts
///   line   spread 1/sqrt(rho), path rho, from a straight line: p in volts over the root of a metre
///   plane  spread 1, path d . (r - position)
struct RaySource {
  Spreading spreading = Spreading::point;  // form of its waves
  dvec3 position{0.0};                     // place of the source, or where the phase of a plane wave is zero [m]
  dvec3 direction{0, 0, 1};                // unit: of travel of a plane wave, along a line; no meaning for a point
  ComplexVector moment;                    // p
};

/// What a straight ray from the source brings to a point.
struct Arrival {
  dvec3 direction;  // d, unit
  double path;      // [m]
  double spread;    // as in free_field()
};
/// Along the straight line from the source.
Arrival arrival(const RaySource& source, const dvec3& point);

/// `moment` across the ray of this direction.
inline ComplexVector across(const ComplexVector& moment, const dvec3& direction) {
  return moment - dot(moment, direction) * direction;
}

/// E at a point [V/m] that is not on the source; `wavenumber` in rad/m.
ComplexVector free_field(const RaySource& source, const dvec3& point, double wavenumber);

}  // namespace raytube
