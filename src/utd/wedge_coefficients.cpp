#include "utd/wedge_coefficients.h"

#include <cmath>

#include "utd/transition.h"

namespace raytube {

namespace {

constexpr double on_boundary = 1e-12;   // [rad] closer than this the side is undecided: tie rule
constexpr double near_boundary = 1e-7;  // [rad] closer than this cot and F are replaced by their product's expansion

/// Kouyoumjian and Pathak (1974), small-argument form of cot times F close to a boundary, at the signed angular distance eps.
/// Valid for |eps| << 1: relative error k L eps^2 / 2, below 1e-9 at k L = 1e5.
Complex cotangent_times_transition_near(double n, double eps, double k_distance) {
  const double side = std::abs(eps) < on_boundary ? 0.0 : std::copysign(1.0, eps);
  const Complex turn = std::polar(1.0, pi / 4);
  return n * (std::sqrt(2 * pi * k_distance) * side - 2 * k_distance * eps * turn) * turn;
}

/// cot[(pi + sign beta)/2n] F[k L a] of the same paper. The signed angular distance eps to the term's boundary is formed first:
/// both factors depend on it alone, and 2 cos^2 of an angle near pi would lose it.
Complex cotangent_times_transition(double n, double beta, int sign, double k_distance) {
  const double image = std::round((beta + sign * pi) / (2 * pi * n));
  const double eps = pi - sign * (2 * pi * n * image - beta);
  if (std::abs(eps) < near_boundary) return cotangent_times_transition_near(n, eps, k_distance);
  const double half_sine = std::sin(eps / 2);
  return transition(k_distance * 2 * half_sine * half_sine) / std::tan(eps / (2 * n));
}

Complex both_signs(double n, double beta, double k_distance) {
  return cotangent_times_transition(n, beta, +1, k_distance) + cotangent_times_transition(n, beta, -1, k_distance);
}

}  // namespace

WedgeCoefficients wedge_coefficients(const DiffractedRay& ray, double wavenumber) {
  const double k_distance = wavenumber * ray.distance_parameter;
  const Complex factor = -std::polar(1.0, -pi / 4) / (2 * ray.n * std::sqrt(2 * pi * wavenumber) * ray.sin_cone);
  const Complex incident = both_signs(ray.n, ray.observation_angle - ray.source_angle, k_distance);
  const Complex reflected = both_signs(ray.n, ray.observation_angle + ray.source_angle, k_distance);
  return {factor * (incident - reflected), factor * (incident + reflected)};
}

}  // namespace raytube
