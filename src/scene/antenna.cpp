#include "scene/antenna.h"

#include <algorithm>
#include <cmath>

namespace raytube {

double PatternCut::level(double angle) const {
  if (angles.empty()) return 0.0;
  const auto above = std::ranges::upper_bound(angles, angle);
  if (above == angles.begin()) return levels.front();
  if (above == angles.end()) return levels.back();
  const auto i = static_cast<std::size_t>(above - angles.begin());
  const double share = (angle - angles[i - 1]) / (angles[i] - angles[i - 1]);
  return levels[i - 1] + share * (levels[i] - levels[i - 1]);
}

bool PatternCut::reaches(double angle) const { return angles.empty() || (angle >= angles.front() && angle <= angles.back()); }

double AntennaPattern::amplitude(double azimuth_angle, double elevation_angle) const {
  const double a = azimuth_angle / azimuth_beamwidth, e = elevation_angle / elevation_beamwidth;
  const double level = azimuth.level(azimuth_angle) + elevation.level(elevation_angle);
  return std::exp(-2.0 * std::numbers::ln2 * (a * a + e * e)) * std::pow(10.0, level / 20.0);
}

namespace {

dvec3 image(const dvec3& point, const dvec3& origin, const std::optional<double>& mirror) {
  return mirror ? dvec3(point.x, point.y, 2.0 * (origin.z + *mirror) - point.z) : point;
}

}  // namespace

// In the triad of a mirrored direction radial and phi_hat are mirrored, theta_hat is turned round, too: what is up for an antenna
// is down for its image.
Antenna::Antenna(const AntennaPosition& position, const dvec3& origin, const dvec3& aim, const AntennaPattern& pattern)
    : reference_(image(origin, origin, position.mirror)),
      basis_(spherical_basis(position.direction)),
      range_(position.range),
      // Towards `aim`, with both sides divided by the range.
      axis_(glm::normalize((image(aim, origin, position.mirror) - reference_) / range_ - basis_.radial)),
      azimuth_hat_(carried(basis_.phi_hat, -basis_.radial, axis_)),
      elevation_hat_(carried(position.mirror ? basis_.theta_hat : -basis_.theta_hat, -basis_.radial, axis_)),
      pattern_(pattern) {}

dvec2 Antenna::off_axis(const dvec3& direction) const {
  const dvec2 across{glm::dot(azimuth_hat_, direction), glm::dot(elevation_hat_, direction)};
  const double sine = glm::length(across);
  return sine == 0.0 ? dvec2(0.0) : across * (std::atan2(sine, glm::dot(axis_, direction)) / sine);
}

AntennaRay Antenna::ray_to(const dvec3& point) const {
  const dvec3 step = point - reference_, way = step - range_ * basis_.radial;
  const double distance = glm::length(way);
  AntennaRay ray;
  ray.path = (glm::dot(step, step) - 2.0 * range_ * glm::dot(step, basis_.radial)) / (distance + range_);
  ray.direction = way / distance;
  double amplitude = range_ / distance;
  if (!pattern_.isotropic()) {
    const dvec2 angles = off_axis(ray.direction);
    amplitude *= pattern_.amplitude(angles.x, angles.y);
  }
  ray.field[0] = amplitude * carried(basis_.theta_hat, -basis_.radial, ray.direction);
  ray.field[1] = amplitude * carried(basis_.phi_hat, -basis_.radial, ray.direction);
  return ray;
}

SphericalBasis Antenna::basis_at(const dvec3& point) const {
  const dvec3 direction = ray_to(point).direction, from = -basis_.radial;
  return {-direction, carried(basis_.theta_hat, from, direction), carried(basis_.phi_hat, from, direction)};
}

}  // namespace raytube
