#include "utd/filon.h"

#include <cmath>

#include "gauss.h"

namespace raytube {

namespace {

// Below it e^{j theta x} itself is as good as a polynomial; above, the upward recurrence of the Bessel functions is stable.
constexpr double slow = 4.0;

}  // namespace

const FilonRule& FilonRule::get() {
  static const FilonRule rule;
  return rule;
}

FilonRule::FilonRule() {
  const std::span<const GaussPoint> rule = gauss_rule(lanes);
  for (std::size_t i = 0; i < lanes; ++i) {
    at[i] = 2 * rule[i].place - 1;
    gauss_[i] = 2 * rule[i].weight;
    double before = 0.0, value = 1.0;
    for (int n = 0; n < static_cast<int>(lanes); ++n) {
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
  double even = std::sin(theta) / theta, odd = (even - std::cos(theta)) / theta;  // j_n and j_{n+1} of theta
  for (int n = 0; n < static_cast<int>(lanes); n += 2) {
    for (std::size_t i = 0; i < lanes; ++i) {
      result.re[i] += even * legendre_[n][i];
      result.im[i] += odd * legendre_[n + 1][i];
    }
    even = (2 * n + 3) / theta * odd - even;
    odd = (2 * n + 5) / theta * even - odd;
  }
  return result;
}

}  // namespace raytube
