// The waves of antennas at a finite distance by their definition alone.
#pragma once

#include <array>

#include "scene/sweep.h"

namespace raytube::point_waves {

inline Look near_look(const Direction& transmit, const Direction& receive, double transmit_range, double receive_range) {
  return {transmit, receive, transmit_range, receive_range};
}
inline Look near_look(const Direction& direction, double range) { return near_look(direction, direction, range, range); }

/// E of an antenna at a point: unit at the origin, falling as 1/r, V and H turned with the ray.
struct PointWave {
  dvec3 direction;
  std::array<dvec3, 2> field;
  double path;
};
inline PointWave wave_at(const Direction& direction, double range, const dvec3& r) {
  const SphericalBasis basis = spherical_basis(direction);
  const dvec3 way = r - range * basis.radial;
  const double distance = glm::length(way);
  PointWave wave{way / distance, {basis.theta_hat, basis.phi_hat}, distance - range};
  const dvec3 from = -basis.radial, axis = glm::cross(from, wave.direction);
  for (dvec3& e : wave.field)  // Rodrigues' rotation from the axis to the ray
    e = range / distance *
        (glm::dot(from, wave.direction) * e + glm::cross(axis, e) +
         axis * (glm::dot(axis, e) / (1.0 + glm::dot(from, wave.direction))));
  return wave;
}

inline double level_difference(Complex a, Complex b) { return std::abs(20.0 * std::log10(std::abs(a) / std::abs(b))); }

}  // namespace raytube::point_waves
