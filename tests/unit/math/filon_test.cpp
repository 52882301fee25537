// Quadrature of a smooth function times a fast phase.
#include <gtest/gtest.h>

#include "math/filon.h"
#include "math/gauss.h"

namespace raytube {
namespace {

constexpr int count = lanes;

// Slow ones, those where the rule changes its way, fast ones.
const double phases[] = {0.0, 1e-9, 0.3, 2.0, 3.9, 4.1, 7.9, 8.1, 15.0, 60.0, 1e3, 1e4};

/// Integral of P_n(x) e^{j theta x} over [-1, 1]: 2 j^n j_n(theta) (Abramowitz & Stegun 1964, 10.1.14), of half-integer order.
Complex exact(unsigned n, double theta) {
  const double bessel = theta == 0.0 ? (n == 0 ? 1.0 : 0.0) : std::sph_bessel(n, theta);
  return 2 * bessel * std::polar(1.0, pi / 2 * n);
}

double worst_error(unsigned degree, double theta) {
  const FilonRule& rule = FilonRule::get();
  Complex sum = 0.0, negative = 0.0;
  const Complexes weights = rule.weights(theta), back = rule.weights(-theta);
  for (int i = 0; i < count; ++i) {
    sum += weights[i] * std::legendre(degree, rule.at[i]);
    negative += back[i] * std::legendre(degree, rule.at[i]);
  }
  return std::max(std::abs(sum - exact(degree, theta)), std::abs(negative - std::conj(exact(degree, theta))));
}

/// What a Gauss rule may miss of P_n e^{j theta x}: products of degree 2 count and more with the Legendre series of the phase,
/// sum (2m + 1) j^m j_m(theta) P_m, each at most 2; j_m(theta) <= theta^m / (2m + 1)!!.
double gauss_remainder(unsigned degree, double theta) {
  double bound = 0.0, bessel = 1.0;
  for (unsigned m = 0; m < 2 * count + 20; ++m, bessel *= theta / (2 * m + 1))
    if (m + degree >= 2 * count) bound += 2 * (2 * m + 1) * bessel;
  return bound;
}

TEST(Filon, ExactForPolynomials) {
  for (const double theta : phases)
    for (unsigned degree = 0; degree < count; ++degree) {
      // Rounding: of the phase, 2^-52 theta, and of the recurrence, some 1e-13 where it begins.
      const double slow = theta <= 4.0 ? gauss_remainder(degree, theta) : 0.0;
      EXPECT_LE(worst_error(degree, theta), 2e-13 + 1e-16 * theta + slow) << "degree " << degree << " at " << theta;
    }
}

// Rounding grows with y_7, 5e2 at 2, times 15 of its weight.
TEST(Filon, BothEndsTogetherAreTheWhole) {
  const FilonRule& rule = FilonRule::get();
  for (const double theta : {2.0, -2.0, 3.9, 8.1, -15.0, 60.0, 1e3}) {
    const Complexes weights = rule.weights(theta);
    const FilonRule::Ends ends = rule.end_weights(theta);
    for (int i = 0; i < count; ++i) {
      const Complex sum = std::polar(1.0, -theta) * ends.begin[i] + std::polar(1.0, theta) * ends.end[i];
      EXPECT_LE(std::abs(sum - weights[i]), 5e-12) << theta;
    }
  }
}

// 1 / (2 + x): its Legendre series falls as (2 + sqrt 3)^-n, so does what interpolation leaves out.
TEST(Filon, AgreesWithManyGaussPoints) {
  const FilonRule& rule = FilonRule::get();
  for (const double theta : {0.0, 1.0, 3.9, 4.1, 7.9, 8.1, 30.0, 200.0}) {
    Complex sum = 0.0, fine = 0.0;
    const Complexes weights = rule.weights(theta);
    for (int i = 0; i < count; ++i) sum += weights[i] / (2 + rule.at[i]);
    const int panels = 20;  // of at most 20 rad, which 48 points resolve to rounding
    for (int panel = 0; panel < panels; ++panel)
      for (const GaussPoint& point : gauss_rule(48)) {
        const double x = 2 * (panel + point.node) / panels - 1;
        fine += 2 * point.weight / panels / (2 + x) * std::polar(1.0, theta * x);
      }
    EXPECT_LE(std::abs(sum - fine), 10 * std::pow(2 + std::sqrt(3.0), -count)) << theta;
  }
}

}  // namespace
}  // namespace raytube
