// The plane waves of a look at the points of a surface.
#pragma once

#include <optional>

#include "utd/wedge/near_look.h"

namespace raytube {

/// What stands for `receive` before the current J of a face where M = -Z n x J is wanted, over Z: M radiates (s x p) . M where J
/// radiates p . eta J.
inline std::array<dvec3, 2> receiver_of_magnetic_currents(const LookVectors& look, const dvec3& normal) {
  const auto turned = [&](const dvec3& p) { return glm::cross(normal, glm::cross(look.scattered, p)); };
  return {turned(look.receive[0]), turned(look.receive[1])};
}

/// From antennas at infinity the same everywhere, from those at a finite distance what their waves are at each point.
class LocalLook {
 public:
  LocalLook(const LookVectors& look) : here_(look) {}
  LocalLook(const NearLook& near) : near_(near) {}

  /// Until it is asked for another point.
  const LookVectors& at(const dvec3& point) {
    if (near_) here_ = near_->at(point);
    return here_;
  }
  dvec3 incident(const dvec3& point) const { return near_ ? near_->incident(point) : here_.incident; }

  /// Phases over k, less those at the reference: of the wave that comes to a point, of what it sends on, and of both [m].
  double arriving(const dvec3& point) const { return near_ ? -near_->path_in(point) : -glm::dot(here_.incident, point); }
  double leaving(const dvec3& point) const { return near_ ? -near_->path_out(point) : glm::dot(here_.scattered, point); }
  double both(const dvec3& point) const {
    return near_ ? -near_->path_over(point) : glm::dot(here_.scattered - here_.incident, point);
  }

  /// Curvature of the wave that comes there [1/m].
  double spreading(const dvec3& point) const { return near_ ? 1.0 / near_->transmitter_distance(point) : 0.0; }

 private:
  std::optional<NearLook> near_;
  LookVectors here_;
};

}  // namespace raytube
