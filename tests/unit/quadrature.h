// Gauss-Legendre rules and the exact field on a face of a wedge, for tests that integrate it.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Nodes and weights on (0, 1), by Newton's method on the Legendre recurrence.
struct GaussLegendre {
  std::vector<double> nodes, weights;

  explicit GaussLegendre(int count) {
    for (int i = 0; i < count; ++i) {
      double x = std::cos(pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
      for (int pass = 0; pass < 8; ++pass) {
        double previous = 1.0, value = x;
        for (int m = 2; m <= count; ++m) previous = std::exchange(value, ((2 * m - 1) * x * value - (m - 1) * previous) / m);
        slope = count * (x * value - previous) / (x * x - 1);
        x -= value / slope;
      }
      nodes.push_back((1 + x) / 2);
      weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
  }
};

/// On the face phi = 0 at k rho = x: H_z for unit hard, dE_z/(k dy) for unit soft incidence from phi' (Bowman, Senior and
/// Uslenghi 1969): H_z = (2/n) sum eps_m j^nu J_nu cos(nu phi'), dE_z/(k dy) = (4/n) sum j^nu nu J_nu / x sin(nu phi'), nu = m/n.
struct WedgeField {
  Complex hard, soft_slope;
};

inline WedgeField wedge_field(double n, double source, double x) {
  WedgeField field{};
  const int last = static_cast<int>(std::ceil(n * (x + 12 * std::cbrt(x) + 25)));
  for (int m = 0; m <= last; ++m) {
    const double order = m / n;
    const Complex term = std::cyl_bessel_j(order, x) / n * std::polar(1.0, pi * order / 2);
    field.hard += (m == 0 ? 2.0 : 4.0) * std::cos(order * source) * term;
    field.soft_slope += 4 * order * std::sin(order * source) / x * term;
  }
  return field;
}

}  // namespace raytube
