// Fock's functions as fitted against their integrals and their series of creeping waves.
#include <gtest/gtest.h>

#include <cmath>

#include "utd/fock/fock.h"

namespace raytube {
namespace {

// Airy's functions and their derivatives, of Bessel functions (DLMF 9.6.2 to 9.6.9).
struct Airy {
  double ai, ai_slope, bi, bi_slope;
};
Airy airy(double x) {
  const double z = 2.0 / 3.0 * x * std::sqrt(x), third = std::sqrt(x / 3.0), sine = std::sqrt(3.0) / 2;
  const double k1 = std::cyl_bessel_k(1.0 / 3, z), k2 = std::cyl_bessel_k(2.0 / 3, z);
  const double i1 = std::cyl_bessel_i(1.0 / 3, z), i2 = std::cyl_bessel_i(2.0 / 3, z);
  return {third * k1 / pi, -x / (pi * std::sqrt(3.0)) * k2, third * (2 * i1 + 2 / pi * sine * k1),
          x / std::sqrt(3.0) * (2 * i2 + 2 / pi * sine * k2)};
}
double ai_at_minus(double x) {
  const double z = 2.0 / 3.0 * x * std::sqrt(x);
  return std::sqrt(x) / 3 * (1.5 * std::cyl_bessel_j(1.0 / 3, z) - std::sqrt(0.75) * std::cyl_neumann(1.0 / 3, z));
}
double slope_at_minus(double x) {
  const double z = 2.0 / 3.0 * x * std::sqrt(x);
  return x / 3 * (1.5 * std::cyl_bessel_j(2.0 / 3, z) + std::sqrt(0.75) * std::cyl_neumann(2.0 / 3, z));
}

// The integrals of fock.h along both parts of their contour, where Ai(r e^{-+j 2 pi/3}) = e^{-+j pi/3} (Ai(r) +- j Bi(r)) / 2
// (DLMF 9.2.11). Midpoint rule: error h^2/24 times the integrands' slopes at zero, some 3e-7.
FockCurrents by_quadrature(double xi) {
  constexpr double h = 2e-3, end = 36.0;
  const Complex j(0, 1), turn = std::polar(1.0, -2 * pi / 3);
  Complex hard = 0.0, soft = 0.0;
  for (double r = 0.5 * h; r < end; r += h) {
    const Airy a = airy(r);
    const Complex out = h * std::exp(-j * xi * r), in = h * turn * std::exp(-j * xi * r * turn);
    hard += 2.0 * (out / (std::polar(1.0, -pi / 3) * Complex(a.ai_slope, a.bi_slope)) + in / Complex(a.ai_slope, -a.bi_slope));
    soft +=
        2.0 * (out / (std::polar(1.0, -pi / 3) * Complex(a.ai, a.bi)) - in / (std::polar(1.0, pi / 3) * Complex(a.ai, -a.bi)));
  }
  return {hard * std::polar(1.0, pi / 6) / (2 * pi), soft * std::polar(1.0, -pi / 3) / (2 * pi)};
}

// Sixty creeping waves: at xi = 0.5 the next one is e^{-0.43 * 43} of the first.
FockCurrents by_residues(double xi) {
  Complex hard = 0.0, soft = 0.0;
  for (int n = 0; n < 60; ++n) {
    double t = std::pow(3 * pi * (4 * n + 3) / 8, 2.0 / 3), u = n == 0 ? 1.02 : std::pow(3 * pi * (4 * n + 1) / 8, 2.0 / 3);
    for (int i = 0; i < 8; ++i) {
      t += ai_at_minus(t) / slope_at_minus(t);
      u -= slope_at_minus(u) / (u * ai_at_minus(u));
    }
    hard += std::exp(Complex(0, -xi * u) * std::polar(1.0, -pi / 3)) / (u * ai_at_minus(u));
    soft += std::exp(Complex(0, -xi * t) * std::polar(1.0, -pi / 3)) / slope_at_minus(t);
  }
  return {hard, soft * std::polar(1.0, -pi / 6)};
}

TEST(Fock, InTheDarkIsTheSumOfCreepingWaves) {
  // What fock_fit.py says of its fits; beyond 4 two waves are left, and the third is 3e-8.
  for (double xi = 0.5; xi < 9.0; xi += 0.0625) {
    const FockCurrents fit = fock_in_the_dark(xi), exact = by_residues(xi);
    EXPECT_LE(std::abs(fit.hard - exact.hard), 5e-6) << xi;
    EXPECT_LE(std::abs(fit.soft - exact.soft), 5e-6) << xi;
  }
}

TEST(Fock, InTheDarkIsTheIntegral) {
  for (const double xi : {0.0, 0.1, 0.2, 0.35, 0.5, 1.0}) {
    const FockCurrents fit = fock_in_the_dark(xi), exact = by_quadrature(xi);
    EXPECT_LE(std::abs(fit.hard - exact.hard), 5e-6) << xi;
    EXPECT_LE(std::abs(fit.soft - exact.soft), 5e-6) << xi;
  }
}

TEST(Fock, OnTheLitSideIsTheIntegral) {
  // 1e-6 of the fits, and the quadrature's rounding: its integrand is e^{(0.87 xi)^3 / 3} times the result, 1e4 at xi = -3.5.
  for (const double xi : {-1e-6, -0.1, -0.4, -1.0, -1.5, -2.0, -2.5, -2.9, -3.1, -3.5}) {
    const FockCurrents fit = fock_factors(xi), exact = by_quadrature(xi);
    const Complex back = std::polar(1.0, -xi * xi * xi / 3);
    EXPECT_LE(std::abs(2.0 * fit.hard - back * exact.hard), 5e-6) << xi;
    EXPECT_LE(std::abs(-2 * xi * fit.soft - back * exact.soft), 1e-5) << xi;
  }
}

TEST(Fock, FarOffPhysicalOpticsIsRight) {
  EXPECT_LE(std::abs(fock_factors(-30.0).hard - 1.0), 1e-5);
  EXPECT_LE(std::abs(fock_factors(-30.0).soft - 1.0), 1e-5);
}

TEST(Fock, PiecesOfTheFitsMeet) {
  // Within what both are off.
  const auto step = [](auto function, double at) {
    const FockCurrents a = function(at - 1e-9), b = function(at + 1e-9);
    return std::max(std::abs(a.hard - b.hard), std::abs(a.soft - b.soft));
  };
  EXPECT_LE(step(fock_in_the_dark, 4.0), 1e-6);
  EXPECT_LE(step(fock_factors, -3.0), 3e-6);
}

}  // namespace
}  // namespace raytube
