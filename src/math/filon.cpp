#include "math/filon.h"

#include <cmath>

#include "math/gauss.h"

namespace raytube {

namespace {

constexpr int orders = lanes;
// Below it the Gauss rule itself is exact to rounding.
constexpr double slow = 0.3;

// j_0 .. j_7: upwards where that is stable, else downwards from where they vanish, scaled by the larger of j_0 and j_1 (Miller).
// Begun at the order N that is off by j_N(x) y_7(x) / (y_N(x) j_7(x)) of j_7, below rounding for N = 12 + 2x (DLMF 10.74(iv)).
std::array<double, lanes> spherical_bessel(double x) {
  std::array<double, lanes> j;
  j[0] = std::sin(x) / x;
  j[1] = (j[0] - std::cos(x)) / x;
  if (std::abs(x) >= orders) {
    for (int n = 1; n + 1 < orders; ++n) j[n + 1] = (2 * n + 1) / x * j[n] - j[n - 1];
    return j;
  }
  std::array<double, lanes> shape;
  double above = 0.0, here = 1e-60;
  for (int n = 12 + static_cast<int>(2.0 * std::abs(x)); n >= 0; --n) {
    if (n < orders) shape[n] = here;
    const double below = (2 * n + 1) / x * here - above;
    above = here;
    here = below;
  }
  const double scale = std::abs(j[0]) > std::abs(j[1]) ? j[0] / shape[0] : j[1] / shape[1];
  for (int n = 0; n < orders; ++n) j[n] = scale * shape[n];
  return j;
}

}  // namespace

const FilonRule& FilonRule::get() {
  static const FilonRule rule;
  return rule;
}

FilonRule::FilonRule() {
  const std::span<const GaussPoint> rule = gauss_rule(lanes);
  for (std::size_t i = 0; i < lanes; ++i) {
    at[i] = 2 * rule[i].node - 1;
    gauss_[i] = 2 * rule[i].weight;
    double before = 0.0, value = 1.0;
    for (int n = 0; n < orders; ++n) {
      legendre_[n][i] = (n % 4 < 2 ? 1 : -1) * gauss_[i] * (2 * n + 1) * value;
      const double next = ((2 * n + 1) * at[i] * value - n * before) / (n + 1);
      before = value;
      value = next;
    }
  }
}

Complexes FilonRule::weights(double theta) const {
  if (std::abs(theta) <= slow) {
    Reals angle;
    for (std::size_t i = 0; i < lanes; ++i) angle[i] = theta * at[i];
    Complexes result = unit_phasors(angle);
    for (std::size_t i = 0; i < lanes; ++i) {
      result.re[i] *= gauss_[i];
      result.im[i] *= gauss_[i];
    }
    return result;
  }
  Complexes result{};
  const std::array<double, lanes> bessel = spherical_bessel(theta);
  for (int n = 0; n < orders; n += 2)
    for (std::size_t i = 0; i < lanes; ++i) {
      result.re[i] += bessel[n] * legendre_[n][i];
      result.im[i] += bessel[n + 1] * legendre_[n + 1][i];
    }
  return result;
}

// 2 j_n = h_n + conj(h_n), h_n the spherical Hankel functions of the first kind: e^{jx} times a polynomial of 1/x (DLMF 10.49.6),
// here from upward recurrence (DLMF 10.51.1), in which they do not decrease.
FilonRule::Ends FilonRule::end_weights(double theta) const {
  const double x = std::abs(theta);
  Complex before(1.0 / x, 0.0), h(0.0, -1.0 / x);  // h_{-1} e^{-jx}, h_0 e^{-jx}
  Ends result{};
  for (int n = 0; n < orders; ++n) {
    const Complex end = n % 2 == 0 ? h / 2.0 : Complex(-h.imag() / 2, h.real() / 2);
    const Complex begin = n % 2 == 0 ? std::conj(end) : -std::conj(end);
    for (std::size_t i = 0; i < lanes; ++i) {
      result.end.re[i] += end.real() * legendre_[n][i];
      result.end.im[i] += end.imag() * legendre_[n][i];
      result.begin.re[i] += begin.real() * legendre_[n][i];
      result.begin.im[i] += begin.imag() * legendre_[n][i];
    }
    const Complex next = (2 * n + 1) / x * h - before;
    before = h;
    h = next;
  }
  if (theta > 0.0) return result;
  for (std::size_t i = 0; i < lanes; ++i) {
    result.begin.im[i] = -result.begin.im[i];
    result.end.im[i] = -result.end.im[i];
  }
  return result;
}

// With 2u the phase's change, even is the mean of the ends times tan(u) / 2u and odd the same times j (tan(u) / u - 1) / 2u: by
// the series of the tangent, as far as rounding, where the ends nearly cancel.
FilonStep filon_step(double phase_from, double phase_to, Complex at_from, Complex at_to) {
  constexpr double small = 0.1;
  const double u = 0.5 * (phase_to - phase_from), u2 = u * u;
  const Complex quarter = 0.25 * (at_from + at_to);
  if (std::abs(u) >= small) {
    const Complex even = Complex(0, -0.25 / u) * (at_to - at_from);
    return {even, Complex(0, 1 / u) * (even - quarter)};
  }
  const double more = 1.0 / 3 + u2 * (2.0 / 15 + u2 * (17.0 / 315 + u2 * (62.0 / 2835 + u2 * (1382.0 / 155925))));
  return {(1.0 + u2 * more) * quarter, Complex(0, u * more) * quarter};
}

}  // namespace raytube
