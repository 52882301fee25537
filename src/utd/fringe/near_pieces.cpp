#include "utd/fringe/near_pieces.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

/// A phase over the target that counts as none [rad].
constexpr double least_phase = 0.01;

/// What is left of phase off the linear one at the ends of a piece [rad], and the turn of the directions along it [rad].
constexpr double most_bend = 0.1, most_turn = 0.02;

}  // namespace

double bend_over_target(const Antenna& antenna, double wavenumber, double radius) {
  const double reach = glm::length(antenna.reference()) + radius;
  return wavenumber * reach * reach / antenna.range();
}

NearLook::NearLook(const NearAntennas& antennas, double wavenumber, double radius)
    : antennas_(antennas),
      parallel_in_(bend_over_target(antennas.transmit.antenna(), wavenumber, radius) < least_phase),
      parallel_out_(bend_over_target(*antennas.receive, wavenumber, radius) < least_phase) {}

LookVectors NearLook::at(const dvec3& point) const {
  const AntennaRay in = antennas_.transmit.ray_to(point), out = antennas_.receive->ray_to(point);
  LookVectors look{in.direction, -out.direction, in.field, {}, out.field};
  if (parallel_in_) look.incident = -antennas_.transmit.radial();
  if (parallel_out_) look.scattered = antennas_.receive->radial();
  for (int q = 0; q < 2; ++q) look.magnetic[q] = glm::cross(look.incident, in.field[q]);
  return look;
}

/// Both ways from antenna to antenna over a point, less the ranges.
double PieceCutter::path_over(const dvec3& point) const {
  return near_.antennas().transmit.ray_to(point).path + near_.antennas().receive->ray_to(point).path;
}

void PieceCutter::cut(const Wedge& wedge, double begin, double end, std::vector<NearPiece>& pieces) const {
  const auto point = [&](double fraction) { return glm::mix(wedge.start, wedge.end, fraction); };
  const double middle = 0.5 * (begin + end);
  const dvec3 at = point(middle);
  const double path = path_over(at), bend = 0.5 * (path_over(point(begin)) + path_over(point(end))) - path;
  const double half = 0.5 * (end - begin) * wedge.length();
  const NearAntennas& antennas = near_.antennas();
  const double nearest =
      std::min(glm::distance(antennas.transmit.position(), at), glm::distance(antennas.receive->position(), at));
  if (wavenumber_ * std::abs(bend) > most_bend || half > most_turn * nearest) {
    cut(wedge, begin, middle, pieces);
    return cut(wedge, middle, end, pieces);
  }
  const LookVectors look = near_.at(at);
  // The mean of a phase that bends as a parabola is a third of what its ends have.
  pieces.push_back({begin, end, at, look, path + bend / 3.0 + glm::dot(look.scattered - look.incident, at)});
}

}  // namespace raytube
