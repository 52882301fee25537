#include "utd/fock/fock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "utd/fock/fock_fit.h"

namespace raytube {

namespace {

using namespace fock_fit;

template <std::size_t count>
Complex at(const std::array<Complex, count>& polynomial, double x) {
  double re = 0.0, im = 0.0;
  for (const Complex& c : polynomial) {
    re = re * x + c.real();
    im = im * x + c.imag();
  }
  return {re, im};
}

// How a creeping wave turns and falls.
Complex creeping(double zero, double xi) { return std::polar(std::exp(-zero * xi * std::numbers::sqrt3 / 2), -0.5 * zero * xi); }

template <std::size_t count>
Complex in_the_dark(const std::array<Complex, count>& near, const std::array<Complex, 2>& modes,
                    const std::array<double, 2>& zeros, double xi) {
  if (xi < dark_end) return at(near, 2 * xi / dark_end - 1) * creeping(zeros[0], xi);
  return modes[0] * creeping(zeros[0], xi) + modes[1] * creeping(zeros[1], xi);
}

}  // namespace

FockCurrents fock_in_the_dark(double xi) {
  return {in_the_dark(hard_dark, hard_modes, hard_zeros, xi), in_the_dark(soft_dark, soft_modes, soft_zeros, xi)};
}

void DarkWay::step(double curvature, double gaussian, double h) {
  constexpr double hard = hard_zeros[0], soft = soft_zeros[0], cbrt_of_2 = 1.259921049894873165;
  constexpr double along_hard = hard * hard / 60 + 0.1 / hard, along_soft = soft * soft / 60, across_hard = 0.25 / hard;
  if (curvature <= 0.0) return;
  const double root = std::cbrt(curvature), turn = h * cbrt_of_2 * root;
  const double across = std::clamp(gaussian / curvature, -curvature, curvature);
  distance_ += h * root * root / cbrt_of_2;
  bends_ += h * root;
  hard_more_ += turn * (along_hard * curvature - across_hard * across);
  soft_more_ += turn * along_soft * curvature;
}

FockCurrents DarkWay::with_second_order(const FockCurrents& first, double wavenumber) const {
  // The part of the first order's exponent that the second one has where it is no longer small beside the first.
  constexpr double most = 0.15;
  const double scale = 1.0 / std::cbrt(wavenumber), xi = distance(wavenumber);
  const auto factor = [&](double more, double zero) {
    const double all = std::max(most * zero * xi, 1e-30);
    return std::exp(-scale * more / std::hypot(1.0, scale * more / all) * std::polar(1.0, -pi / 6));
  };
  return {first.hard * factor(hard_more_, hard_zeros[0]), first.soft * factor(soft_more_, soft_zeros[0])};
}

FockCurrents DarkWay::currents(double wavenumber) const {
  return with_second_order(fock_in_the_dark(distance(wavenumber)), wavenumber);
}

// m d xi = (k/2)^(2/3) kappa^(1/3) ds, and d xi = (k/2)^(1/3) kappa^(2/3) ds.
double DarkWay::scale(double wavenumber) const { return std::cbrt(0.25 * wavenumber) * bends_ / distance_; }

FockCurrents fock_factors(double xi) {
  if (xi < -lit_end) {
    const double cube = 1.0 / (xi * xi * xi), u = lit_end * lit_end * lit_end * cube;
    const Complex first(0.0, 0.25 * cube);
    return {1.0 - first + u * u * at(hard_far, u), 1.0 + first + u * u * at(soft_far, u)};
  }
  const double x = 2 * xi / lit_end + 1;
  return {0.5 * at(hard_lit, x), at(soft_lit, x) / (-2 * xi)};
}

}  // namespace raytube
