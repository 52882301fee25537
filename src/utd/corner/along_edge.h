// A wave on its way along an edge, from one corner to the next.
#pragma once

#include <cmath>

#include "core/field.h"
#include "math/special/elementary.h"

namespace raytube {

/// S of a wave of unit starts over an edge of exterior angle n pi and this length, -(2 pi)^(1 - 1/n) / c0 lambda (lambda /
/// L)^(1/n) e^(-jkL) [m], with c0 = 4 / (j n^2) 2^(-1/n) / Gamma(1 + 1/n) e^(j pi / 2n): docs/theory/corners.md. Valid for kL of
/// some units.
inline Complex along_edge(double n, double length, double wavenumber) {
  const double lambda = 2.0 * pi / wavenumber;
  const Complex c0 =
      Complex(0, -4.0 / (n * n)) * std::polar(std::pow(2.0, -1.0 / n) / gamma_function(1.0 + 1.0 / n), pi / (2.0 * n));
  return std::polar(lambda * std::pow(lambda / length, 1.0 / n), -wavenumber * length) * -std::pow(2.0 * pi, 1.0 - 1.0 / n) / c0;
}

}  // namespace raytube
