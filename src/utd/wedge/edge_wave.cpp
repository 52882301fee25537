#include "utd/wedge/edge_wave.h"

#include <cmath>
#include <numbers>

#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// sin(eps/2) / (n tan(eps/2n)), eps >= 0: 1 on the boundary.
double relative_strength(double n, double eps) {
  if (eps < 1e-8) return 1.0;
  return std::sin(eps / 2) / (n * std::tan(eps / (2 * n)));
}

// Its derivative; close to the boundary that of 1 - eps^2 (1/24 + 1/12n^2).
double relative_strength_slope(double n, double eps) {
  if (eps < 1e-4) return -eps * (1.0 / 12 + 1.0 / (6 * n * n));
  const double sine = std::sin(eps / (2 * n));
  return std::cos(eps / 2) / (2 * n * std::tan(eps / (2 * n))) - std::sin(eps / 2) / (2 * n * n * sine * sine);
}

// `eps` is the signed angular distance to the wave's boundary and `turn` how it changes with the azimuth, 1 or -1. On the
// boundary the mean of both sides counts.
EdgeWaveTerm at_distance(double eps, double turn, double strength, double slope) {
  const double side = std::abs(eps) < tie_guard ? 0.0 : std::copysign(1.0, eps);
  return {-side / 2 * strength, std::numbers::sqrt2 * std::abs(std::sin(eps / 2)), -turn / 2 * slope,
          side * turn * std::cos(eps / 2) / std::numbers::sqrt2};
}

EdgeWaveTerm term(double n, double beta, int sign) {
  const double image = std::round((beta + sign * pi) / (2 * pi * n));
  const double eps = pi - sign * (2 * pi * n * image - beta), distance = std::abs(eps);
  return at_distance(eps, sign, relative_strength(n, distance), relative_strength_slope(n, distance));
}

// The two cotangents of a half plane add up to 2 / cos(beta/2), over one transition function.
EdgeWaveTerm half_plane_term(double beta) {
  const double reduced = beta - 4 * pi * std::round(beta / (4 * pi));
  return at_distance(pi - std::abs(reduced), reduced > 0.0 ? -1.0 : 1.0, 1.0, 0.0);
}

}  // namespace

EdgeWaveTerms edge_wave_terms(double n, double source_angle, double observation_angle) {
  const double difference = observation_angle - source_angle, sum = observation_angle + source_angle;
  if (n == 2.0) return {{half_plane_term(difference), {}}, {half_plane_term(sum), {}}, 1};
  return {{term(n, difference, 1), term(n, difference, -1)}, {term(n, sum, 1), term(n, sum, -1)}, 2};
}

}  // namespace raytube
