#include <gtest/gtest.h>

#include "utd/wedge/transition.h"
#include "utd/wedge/wedge_coefficients.h"

namespace raytube {
namespace {

constexpr double k = 2 * pi;

/// As printed by Kouyoumjian and Pathak (1974): cot[(pi +- beta)/2n] F[kL a] of an angle beta, away from every boundary.
Complex printed_term(double n, double beta, int sign, double k_distance) {
  const double image = std::round((beta + sign * pi) / (2 * pi * n)), cosine = std::cos((2 * pi * n * image - beta) / 2);
  return transition(k_distance * 2 * cosine * cosine) / std::tan((pi + sign * beta) / (2 * n));
}

TEST(WedgeCoefficients, AreTheProductsOfCotangentAndTransitionFunction) {
  const double length = 7.0, cone = 0.8;
  for (const double n : {2.0, 1.75, 1.5, 1.02, 0.75})
    for (const double source : {0.1 * n, 0.45 * n * pi})
      for (const double observer : {0.21 * n * pi, 0.55 * n * pi, 0.93 * n * pi}) {
        const auto both = [&](double beta) {
          return printed_term(n, beta, 1, k * length) + printed_term(n, beta, -1, k * length);
        };
        const Complex factor = -std::polar(1.0, -pi / 4) / (2 * n * std::sqrt(2 * pi * k) * cone);
        const Complex incident = both(observer - source), reflected = both(observer + source);
        const WedgeCoefficients d = wedge_coefficients({n, source, observer, cone, length}, k);
        // Rounding of cotangents of up to 100 and of 2 cos^2, some 1e-14 each.
        EXPECT_LE(std::abs(d.soft - factor * (incident - reflected)), 1e-12) << n << ' ' << source << ' ' << observer;
        EXPECT_LE(std::abs(d.hard - factor * (incident + reflected)), 1e-12) << n << ' ' << source << ' ' << observer;
      }
}

TEST(WedgeCoefficients, SmallArgumentFormBesideABoundary) {
  // Kouyoumjian and Pathak (1974): cot F -> n [sqrt(2 pi k L) sgn(eps) - 2 k L eps e^{j pi/4}] e^{j pi/4}; next term k L eps^2 /
  // 2, here 3e-6. The change over a boundary is that of two such terms, all else being smooth: its own change is 2e-4 of them.
  const double n = 1.5, source = 1.0, length = 100.0, eps = 1e-4;
  const WedgeCoefficients before = wedge_coefficients({n, source, pi + source - eps, 1.0, length}, k);
  const WedgeCoefficients after = wedge_coefficients({n, source, pi + source + eps, 1.0, length}, k);
  const Complex turn = std::polar(1.0, pi / 4), factor = -std::conj(turn) / (2 * n * std::sqrt(2 * pi * k));
  const Complex jump = 2.0 * factor * n * (std::sqrt(2 * pi * k * length) - 2 * k * length * eps * turn) * turn;
  EXPECT_LE(std::abs(before.soft - after.soft - jump), 3e-4 * std::abs(jump));
  EXPECT_LE(std::abs(before.hard - after.hard - jump), 3e-4 * std::abs(jump));
}

TEST(WedgeCoefficients, ObliqueIncidenceScalesWithTheCone) {
  const WedgeCoefficients normal = wedge_coefficients({1.5, 1.0, 3.0, 1.0, 7.0}, k);
  const WedgeCoefficients oblique = wedge_coefficients({1.5, 1.0, 3.0, 0.5, 7.0}, k);
  EXPECT_LE(std::abs(oblique.soft - 2.0 * normal.soft), 1e-15);
  EXPECT_LE(std::abs(oblique.hard - 2.0 * normal.hard), 1e-15);
}

}  // namespace
}  // namespace raytube
