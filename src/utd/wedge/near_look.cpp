#include "utd/wedge/near_look.h"

#include <algorithm>

namespace raytube {

double bend_over_target(const Antenna& antenna, double wavenumber, double radius) {
  const double farthest = glm::length(antenna.reference()) + radius;
  return wavenumber * farthest * farthest / antenna.range();
}

// Waves whose phase bends by less than 0.01 rad over the target are plane.
NearLook::NearLook(const NearAntennas& antennas, double wavenumber, double radius)
    : antennas_(antennas),
      parallel_in_(bend_over_target(antennas.transmit.antenna(), wavenumber, radius) < 0.01),
      parallel_out_(bend_over_target(*antennas.receive, wavenumber, radius) < 0.01) {}

LookVectors NearLook::at(const dvec3& point) const {
  const AntennaRay in = antennas_.transmit.ray_to(point), out = antennas_.receive->ray_to(point);
  LookVectors look{in.direction, -out.direction, in.field, {}, out.field};
  if (parallel_in_) look.incident = -antennas_.transmit.radial();
  if (parallel_out_) look.scattered = antennas_.receive->radial();
  for (int q = 0; q < 2; ++q) look.magnetic[q] = glm::cross(look.incident, in.field[q]);
  return look;
}

dvec3 NearLook::incident(const dvec3& point) const {
  return parallel_in_ ? -antennas_.transmit.radial() : glm::normalize(point - antennas_.transmit.position());
}

double NearLook::nearest(const dvec3& point) const {
  return std::min(transmitter_distance(point), glm::distance(antennas_.receive->position(), point));
}

}  // namespace raytube
