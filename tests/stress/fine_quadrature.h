// Quadrature in long double, against which closed forms in double are held.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

namespace raytube::testing {

using Fine = long double;
using FineComplex = std::complex<Fine>;

/// Gauss-Legendre nodes and weights on (0, 1), by Newton's method on the Legendre recurrence.
struct FineRule {
  std::vector<Fine> nodes, weights;

  explicit FineRule(int count) {
    for (int i = 0; i < count; ++i) {
      Fine x = std::cos(std::numbers::pi_v<Fine> * (i + 0.75L) / (count + 0.5L)), slope = 1.0L;
      for (int pass = 0; pass < 10; ++pass) {
        Fine previous = 1.0L, value = x;
        for (int m = 2; m <= count; ++m) previous = std::exchange(value, ((2 * m - 1) * x * value - (m - 1) * previous) / m);
        slope = count * (x * value - previous) / (x * x - 1);
        x -= value / slope;
      }
      nodes.push_back((1 + x) / 2);
      weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
  }
};

/// Integral over (0, 1) of a function whose phase turns by up to `turn` radians: panels of 8 rad, 24 points each, which leave
/// 4^24 / 48! of it, 1e-47.
template <class Function>
FineComplex fine_integral(Fine turn, Function function) {
  static const FineRule rule(24);
  const int panels = 1 + static_cast<int>(std::abs(turn) / 8);
  FineComplex sum = 0;
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      sum += rule.weights[i] / panels * function((panel + rule.nodes[i]) / panels);
  return sum;
}

}  // namespace raytube::testing
