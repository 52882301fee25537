#include "utd/filon.h"

#include "gauss.h"

namespace raytube {

namespace {

// Below it e^{j theta x} itself is as good as a polynomial; above, the upward recurrence of the Bessel functions is stable.
constexpr double slow(int count) { return count / 2.0; }

}  // namespace

template <int count>
FilonRule<count>::FilonRule() {
  const std::span<const GaussPoint> rule = gauss_rule(count);
  for (int i = 0; i < count; ++i) {
    at[i] = 2 * rule[i].place - 1;
    gauss_[i] = 2 * rule[i].weight;
    double before = 0.0, value = 1.0;
    for (int n = 0; n < count; ++n) {
      legendre_[i][n] = gauss_[i] * (2 * n + 1) * value;
      const double next = ((2 * n + 1) * at[i] * value - n * before) / (n + 1);
      before = value;
      value = next;
    }
  }
}

template <int count>
std::array<Complex, count> FilonRule<count>::weights(double theta) const {
  std::array<Complex, count> result;
  if (std::abs(theta) <= slow(count)) {
    for (int i = 0; i < count; ++i) result[i] = std::polar(gauss_[i], theta * at[i]);
    return result;
  }
  std::array<double, count> bessel;  // j_n(theta)
  const double sine = std::sin(theta), cosine = std::cos(theta);
  bessel[0] = sine / theta;
  bessel[1] = (bessel[0] - cosine) / theta;
  for (int n = 2; n < count; ++n) bessel[n] = (2 * n - 1) / theta * bessel[n - 1] - bessel[n - 2];
  for (int i = 0; i < count; ++i) {
    double even = 0.0, odd = 0.0;  // j^n alternates between the real and the imaginary axis
    for (int n = 0; n < count; ++n) {
      const double term = (n % 4 < 2 ? 1.0 : -1.0) * bessel[n] * legendre_[i][n];
      (n % 2 == 0 ? even : odd) += term;
    }
    result[i] = {even, odd};
  }
  return result;
}

template class FilonRule<8>;
template class FilonRule<16>;

}  // namespace raytube
