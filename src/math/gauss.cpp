#include "math/gauss.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace raytube {

namespace {

using Rule = std::array<GaussPoint, most_gauss_points>;

// Roots of the Legendre polynomial by Newton's method from the usual cosine guess; eight steps reach rounding.
GaussPoint root(int count, int index) {
  double x = std::cos(std::numbers::pi * (index + 0.75) / (count + 0.5)), slope = 1.0;
  for (int pass = 0; pass < 8; ++pass) {
    double before = 1.0, value = x;
    for (int m = 2; m <= count; ++m) before = std::exchange(value, ((2 * m - 1) * x * value - (m - 1) * before) / m);
    slope = count * (x * value - before) / (x * x - 1);
    x -= value / slope;
  }
  return {(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)};
}

std::array<Rule, most_gauss_points> all_rules() {
  std::array<Rule, most_gauss_points> rules{};
  for (int count = 1; count <= most_gauss_points; ++count)
    for (int i = 0; i < count; ++i) rules[count - 1][i] = root(count, i);
  return rules;
}

const std::array<Rule, most_gauss_points> rules = all_rules();

}  // namespace

std::span<const GaussPoint> gauss_rule(int count) { return std::span(rules[count - 1]).first(count); }

}  // namespace raytube
