// The wave that a straight edge sends out when a wave lights it: uniform, so that together with geometrical optics the
// field is continuous over every shadow and reflection boundary.
#pragma once

#include <array>

#include "core/field.h"

namespace raytube {

/// One of the diffracted waves of an edge: its value at the distance rho from the edge's line is strength W(rate sqrt(k rho sin
/// beta0)), W of erfc_ray.h, times the phase e^{-jk s} of the ray of length s = rho / sin beta0. Of a source at any distance it
/// is strength W(rate sqrt(kL)) sqrt(L) A / sin beta0, with the distance parameter L and the spreading factor A.
struct EdgeWaveTerm {
  double strength = 0.0;
  double rate = 0.0;
  double strength_slope = 0.0, rate_slope = 0.0;  // with the azimuth of the observer
};

/// The waves towards one azimuth: `each` belong to the incident wave, as many to the reflected one. With I and R their sums,
/// E_d = -[b0_hat b0'_hat (I - R) + phi_hat phi'_hat (I + R)] . E_i e^{-jk s}.
struct EdgeWaveTerms {
  std::array<EdgeWaveTerm, 2> incident, reflected;
  int each = 2;
};

/// Kouyoumjian and Pathak (1974) for a plane wave, L = s sin^2 beta0, each product of cotangent and transition function written
/// with W: cot[(pi +- beta)/2n] F(kLa) of the angular distance eps to the boundary becomes
///   strength = -sgn(eps) |sin(eps/2)| / (2n tan(|eps|/2n)),   rate = sqrt(2) |sin(eps/2)|,
/// finite everywhere. Exact for n = 2, where the two waves of a pair are one (Sommerfeld 1896). Within 1e-12 rad of a boundary
/// its wave counts nothing: the geometrical-optics ray there must have the weight 1/2. Angles, towards source and observer, are
/// measured from face 0 through free space, both in [0, n pi] [rad].
EdgeWaveTerms edge_wave_terms(double n, double source_angle, double observation_angle);

/// Azimuths at which these waves change their side, inside free space or not: shadow and reflection boundaries [rad].
inline std::array<double, 4> wave_boundaries(double n, double source_angle) {
  return {source_angle + pi, source_angle - pi, pi - source_angle, (2 * n - 1) * pi - source_angle};
}

}  // namespace raytube
