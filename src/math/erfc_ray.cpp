#include "math/erfc_ray.h"

#include <algorithm>
#include <cstdint>

#include "math/erfc_ray_fit.h"

namespace raytube {

namespace {

const Complex turn = std::polar(1.0, pi / 4);

// Taylor series of sqrt(pi) erf(z)/(2z), sum of (-z^2)^m / (m! (2m + 1)) with z^2 = j x^2: real terms in x^4, imaginary ones in
// x^2 times that. The first term left out at the switch is 0.25^12 / (12! 25) = 5e-18.
constexpr std::array<double, 6> erf_series(int first) {
  std::array<double, 6> result{};
  double factorial = 1.0, sign = 1.0;
  for (int m = 0; m < 12; ++m) {
    factorial *= std::max(m, 1);
    if (m % 2 != first) continue;
    result[m / 2] = sign / (factorial * (2 * m + 1));
    sign = -sign;
  }
  return result;
}
constexpr auto erf_real = erf_series(0), erf_imaginary = erf_series(1);

// W' = 2jxW - 2 e^{j pi/4} / sqrt(pi), hence W^(m+1) = 2j (x W^(m) + m W^(m-1)); a difference about its middle has odd
// derivatives only. The first term left out is below 1e-15 where is_removable(a, b) ends.
Complex difference_series(double a, double b, Complex at_middle) {
  const double middle = (a + b) / 2, squared = (a - b) * (a - b) / 4;
  const Complex j2(0.0, 2.0);
  Complex before = at_middle, here = j2 * middle * before - 2 * std::numbers::inv_sqrtpi * turn, sum = here;
  double factor = 1.0;
  for (int m = 1; m < 9; ++m) {
    const Complex next = j2 * (middle * here + static_cast<double>(m) * before);
    before = here;
    here = next;
    if (m % 2 == 1) continue;
    factor *= squared / (m * (m + 1));
    sum += factor * here;
  }
  return sum;
}

}  // namespace

bool is_removable(double x) { return x < 0.5; }

bool is_removable(double a, double b) { return std::abs(a - b) * (1 + (a + b) / 2) <= 0.1; }

Complexes scaled_erfc(const Reals& x) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double scale = 1 / polynomial(erfc_denominator, x[i]);
    result.re[i] = scale * polynomial(erfc_numerator_re, x[i]);
    result.im[i] = scale * polynomial(erfc_numerator_im, x[i]);
  }
  return result;
}

Complex scaled_erfc(double x) {
  Reals alone{};
  alone[0] = x;
  return scaled_erfc(alone)[0];
}

Complexes erf_over(const Reals& x, const Complexes& values, const Complexes& decay) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double x2 = x[i] * x[i], x4 = x2 * x2, scale = std::numbers::sqrt2 * std::numbers::inv_sqrtpi;
    const double re = polynomial(erf_real, x4), im = -x2 * polynomial(erf_imaginary, x4);
    const Complex series(scale * (re - im), scale * (re + im)), quotient = (1.0 - decay[i] * values[i]) / x[i];
    const bool small = is_removable(x[i]);
    result.re[i] = small ? series.real() : quotient.real();
    result.im[i] = small ? series.imag() : quotient.imag();
  }
  return result;
}

Complexes divided_difference(const Reals& a, const Reals& b, const Complexes& at_a, const Complexes& at_b) {
  Complexes result;
  Reals middle;
  std::uint64_t removable = 0;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double inverse = 1 / (a[i] - b[i]);
    result.re[i] = (at_a.re[i] - at_b.re[i]) * inverse;
    result.im[i] = (at_a.im[i] - at_b.im[i]) * inverse;
    middle[i] = (a[i] + b[i]) / 2;
    removable += is_removable(a[i], b[i]) ? 1 : 0;
  }
  if (removable == 0) return result;
  const Complexes at_middle = scaled_erfc(middle);
  for (std::size_t i = 0; i < lanes; ++i)
    if (is_removable(a[i], b[i])) result.set(i, difference_series(a[i], b[i], at_middle[i]));
  return result;
}

}  // namespace raytube
