// The waves of a lit edge: slopes, and what they are on either side of a boundary.
#include <gtest/gtest.h>

#include "math/erfc_ray.h"
#include "utd/wedge/edge_wave.h"
#include "wedge_fields.h"

namespace raytube {
namespace {

struct Boundaries {
  double n, source;
  // Azimuths at which a wave of the wedge jumps.
  std::vector<double> all() const {
    std::vector<double> inside;
    for (const double azimuth : {source + pi, source - pi, pi - source, (2 * n - 1) * pi - source})
      if (azimuth > 0.0 && azimuth < n * pi) inside.push_back(azimuth);
    return inside;
  }
};

const double exponents[] = {2.0, 1.75, 1.5, 1.25, 0.75};
const double sources[] = {0.2, 0.9, 1.6, 2.2};  // [rad] below 0.75 pi

/// Sum of the waves at sqrt(k rho sin beta0) = root.
Complex value(const std::array<EdgeWaveTerm, 2>& terms, int each, double root) {
  Complex sum = 0.0;
  for (int i = 0; i < each; ++i) sum += terms[i].strength * scaled_erfc(terms[i].rate * root);
  return sum;
}

void expect_slopes(double n, double source, double azimuth, double step) {
  const EdgeWaveTerms here = edge_wave_terms(n, source, azimuth), before = edge_wave_terms(n, source, azimuth - step),
                      after = edge_wave_terms(n, source, azimuth + step);
  // Truncation of central differences is step^2 / 6 of the third derivative, at most 1 here but for the strengths of n = 0.75 far
  // from their boundary, 40; rounding is 2^-52 / step.
  const double tolerance = 10 * step * step + 1e-15 / step;
  for (int i = 0; i < here.each; ++i)
    for (const auto set : {&EdgeWaveTerms::incident, &EdgeWaveTerms::reflected}) {
      const EdgeWaveTerm &wave = (here.*set)[i], &low = (before.*set)[i], &high = (after.*set)[i];
      EXPECT_NEAR(wave.strength_slope, (high.strength - low.strength) / (2 * step), tolerance)
          << n << ' ' << source << ' ' << azimuth;
      EXPECT_NEAR(wave.rate_slope, (high.rate - low.rate) / (2 * step), tolerance) << n << ' ' << source << ' ' << azimuth;
    }
}

TEST(EdgeWave, SlopesAreThoseOfTheWave) {
  for (const double n : exponents)
    for (const double source : sources) {
      const std::vector<double> boundaries = Boundaries{n, source}.all();
      for (int i = 1; i < 40; ++i) {
        const double azimuth = n * pi * i / 40;
        const auto close = [&](double boundary) { return std::abs(boundary - azimuth) < 1e-3; };
        if (std::ranges::none_of(boundaries, close)) expect_slopes(n, source, azimuth, 1e-5);
      }
    }
}

TEST(EdgeWave, SlopesCloseToABoundary) {
  int checked = 0;
  for (const double n : exponents)
    for (const double source : sources)
      for (const double boundary : Boundaries{n, source}.all())
        for (const double aside : {1e-2, 2e-4, 1.1e-4, 0.9e-4, 1e-5})
          for (const double side : {-1.0, 1.0}) {
            expect_slopes(n, source, boundary + side * aside, aside / 10);
            ++checked;
          }
  EXPECT_GT(checked, 200);
}

TEST(EdgeWave, JumpsByAUnitWaveOnItsBoundary) {
  // Kouyoumjian & Pathak (1974): the diffracted wave makes up for the ray that ends, one half on either side; on the boundary
  // itself nothing, as the ray has the weight one half. The rest changes by W' sqrt(2) rate ~ 1e-9 root.
  for (const double n : exponents)
    for (const double source : sources)
      for (const double boundary : Boundaries{n, source}.all())
        for (const double root : {0.3, 3.0, 30.0}) {
          const auto sum = [&](double azimuth) {
            const EdgeWaveTerms terms = edge_wave_terms(n, source, azimuth);
            return std::array{value(terms.incident, terms.each, root), value(terms.reflected, terms.each, root)};
          };
          const auto below = sum(boundary - 1e-9), on = sum(boundary), above = sum(boundary + 1e-9);
          double jump = 0.0;
          for (int wave = 0; wave < 2; ++wave) {
            jump += std::abs(above[wave] - below[wave]);
            EXPECT_NEAR(std::abs(above[wave] + below[wave] - 2.0 * on[wave]), 0.0, 1e-8 * root + 1e-8);
          }
          EXPECT_NEAR(jump, 1.0, 1e-8 * root + 1e-8) << n << ' ' << source << ' ' << boundary;
        }
}

TEST(EdgeWave, OfAHalfPlaneIsSommerfelds) {
  // Sommerfeld (1896): ray and diffracted wave are the exact field. The series is good to some 1e-13.
  for (const double k_rho : {0.5, 4.0, 60.0}) {
    const auto exact = wedge_fields::Series::plane(2.0, k_rho);
    for (const double source : sources)
      for (int i = 0; i <= 24; ++i) {
        const double azimuth = 2 * pi * i / 24;
        const EdgeWaveTerms terms = edge_wave_terms(2.0, source, azimuth);
        const auto expect = [&](const std::array<EdgeWaveTerm, 2>& wave, double psi) {
          const Complex ray = std::cos(psi / 2) > 0.0 ? std::polar(1.0, k_rho * std::cos(psi)) : 0.0;
          const Complex diffracted = value(wave, terms.each, std::sqrt(k_rho)) * std::polar(1.0, -k_rho);
          EXPECT_LE(std::abs(ray + diffracted - exact(psi)), 1e-12) << k_rho << ' ' << source << ' ' << azimuth;
        };
        expect(terms.incident, azimuth - source);
        expect(terms.reflected, azimuth + source);
      }
  }
}

}  // namespace
}  // namespace raytube
