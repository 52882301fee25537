// The waves of antennas at a finite distance where they meet a target.
#pragma once

#include "utd/wedge/edge_currents.h"
#include "utd/wedge/image_antenna.h"

namespace raytube {

/// By how much waves of an antenna are not plane at most on a target of this radius about the origin, twice over [rad].
double bend_over_target(const Antenna& antenna, double wavenumber, double radius);

/// Plane waves of their own at every point. What edges send on is not continuous where it runs exactly along another one. Rays
/// that are parallel over the whole target are therefore taken so: the limit of a long range is the far field.
class NearLook {
 public:
  /// The look at a target that reaches `radius` from the origin of its recentred coordinates. Refers to the antennas.
  NearLook(const NearAntennas& antennas, double wavenumber, double radius);

  /// Fields with their amplitudes there, without phase.
  LookVectors at(const dvec3& point) const;
  dvec3 incident(const dvec3& point) const;

  /// From the transmitter and to the receiver, less the ranges [m].
  double path_in(const dvec3& point) const { return antennas_.transmit.ray_to(point).path; }
  double path_out(const dvec3& point) const { return antennas_.receive->ray_to(point).path; }
  double path_over(const dvec3& point) const { return path_in(point) + path_out(point); }

  double transmitter_distance(const dvec3& point) const { return glm::distance(antennas_.transmit.position(), point); }
  double nearest(const dvec3& point) const;  // distance of the nearer antenna [m]

 private:
  NearAntennas antennas_;
  bool parallel_in_, parallel_out_;
};

}  // namespace raytube
