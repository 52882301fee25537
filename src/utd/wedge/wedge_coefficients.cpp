#include "utd/wedge/wedge_coefficients.h"

#include <cmath>

#include "math/erfc_ray.h"
#include "utd/wedge/edge_wave.h"

namespace raytube {

// The terms of EdgeWaveTerms: e^{-j pi/4} / (2n sqrt(2 pi k)) cot F = -sqrt(L) strength W, since F(X) = sqrt(pi) z W(sqrt X).
WedgeCoefficients wedge_coefficients(const DiffractedRay& ray, double wavenumber) {
  const EdgeWaveTerms terms = edge_wave_terms(ray.n, ray.source_angle, ray.observation_angle);
  const double distance = std::sqrt(wavenumber * ray.distance_parameter);
  const double factor = std::sqrt(ray.distance_parameter) / ray.sin_cone;
  const auto sum = [&](const std::array<EdgeWaveTerm, 2>& waves) {
    Complex total = 0.0;
    for (int i = 0; i < terms.each; ++i) total += waves[i].strength * scaled_erfc(waves[i].rate * distance);
    return factor * total;
  };
  const Complex incident = sum(terms.incident), reflected = sum(terms.reflected);
  return {incident - reflected, incident + reflected};
}

}  // namespace raytube
