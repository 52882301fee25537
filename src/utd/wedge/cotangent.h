// Cotangents of the exact current of a wedge and of the physical-optics one.
#pragma once

#include "core/field.h"

namespace raytube {

/// cot z, exactly odd, without cancellation at its pole.
Complex cotangent(Complex z);

/// (1/n) cot(x/2n): the exact current of a wedge has this pole ...
inline Complex wedge_cotangent(double n, Complex x) { return cotangent(x / (2 * n)) / n; }

/// ... which physical optics shares: c_n(x) = (1/n) cot(x/2n) - cot(x/2), regular at x = 0.
Complex cotangent_difference(double n, Complex x);

/// Below this |x| that is a series: x difference_over_argument(n, x^2).
inline constexpr double series_below = 0.02;

/// c_n(x) / x by its Taylor series (Bernoulli numbers). The first term left out is 1e-18 at series_below, while the difference
/// would lose two digits there.
template <class Number>
Number difference_over_argument(double n, Number x2) {
  const double m2 = 1 / (n * n), m4 = m2 * m2;
  return (1 - m2) / 6 + x2 * ((1 - m4) / 360 + x2 * ((1 - m2 * m4) / 15120));
}

}  // namespace raytube
