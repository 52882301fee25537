// Elementary functions whose last bit hangs on the version of the C library (glibc 2.36, 2.41 and 2.43 differ in them), made here
// of those that all of these round alike. tests/determinism/systems looks for calls of most of them.
#pragma once

#include <cmath>

#include "core/field.h"

namespace raytube {

inline double arc_tangent(double x) { return std::atan2(x, 1.0); }

/// x >= 1.
inline double inverse_cosh(double x) { return std::log1p(x - 1.0 + std::sqrt((x - 1.0) * (x + 1.0))); }

/// x > 0, to 1e-14 of the result: Stirling's series (DLMF 5.11.3) where its next term is below that, and Gamma(x + 1) = x
/// Gamma(x).
inline double gamma_function(double x) {
  double product = 1.0;
  for (; x < 12.0; x += 1.0) product *= x;
  const double y = 1.0 / (x * x);
  const double series = (1.0 / 12 - y * (1.0 / 360 - y * (1.0 / 1260 - y * (1.0 / 1680 - y / 1188)))) / x;
  return std::sqrt(2 * pi / x) * std::exp(x * (std::log(x) - 1.0) + series) / product;
}

}  // namespace raytube
