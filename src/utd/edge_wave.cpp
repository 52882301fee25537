#include "utd/edge_wave.h"

#include <cmath>
#include <numbers>

namespace raytube {

namespace {

constexpr double on_boundary = 1e-12;  // [rad] closer than this the side is undecided: tie rule

// |sin(eps/2)| / (n tan(eps/2n)): 1 on the boundary.
double relative_strength(double n, double eps) {
  if (eps < 1e-8) return 1.0;
  return std::sin(eps / 2) / (n * std::tan(eps / (2 * n)));
}

// The wave whose boundary lies the signed angular distance pi - sign (2 pi n N - beta) away.
EdgeWaveTerm term(double n, double beta, int sign) {
  const double image = std::round((beta + sign * pi) / (2 * pi * n));
  const double eps = pi - sign * (2 * pi * n * image - beta), distance = std::abs(eps);
  const double side = distance < on_boundary ? 0.0 : std::copysign(0.5, -eps);
  return {side * relative_strength(n, distance), std::numbers::sqrt2 * std::abs(std::sin(eps / 2))};
}

// The two cotangents of a half plane add up to 2 / cos(beta/2), over one transition function.
EdgeWaveTerm half_plane_term(double beta) {
  const double eps = pi - std::abs(beta - 4 * pi * std::round(beta / (4 * pi)));
  const double side = std::abs(eps) < on_boundary ? 0.0 : std::copysign(0.5, -eps);
  return {side, std::numbers::sqrt2 * std::abs(std::sin(eps / 2))};
}

}  // namespace

EdgeWaveTerms edge_wave_terms(double n, double source_angle, double observation_angle) {
  const double difference = observation_angle - source_angle, sum = observation_angle + source_angle;
  if (n == 2.0) return {{half_plane_term(difference), {}}, {half_plane_term(sum), {}}, 1};
  return {{term(n, difference, 1), term(n, difference, -1)}, {term(n, sum, 1), term(n, sum, -1)}, 2};
}

}  // namespace raytube
