#include "utd/erfc_ray.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "utd/transition.h"

namespace raytube {

namespace {

const Complex turn = std::polar(1.0, pi / 4);

/// Polynomial of the given degree in u, -1 <= u <= 1, through the Chebyshev points.
template <int degree>
class Fit {
 public:
  template <class Function>
  explicit Fit(Function function) {
    constexpr int count = degree + 1;
    std::array<Complex, count> values, chebyshev{};
    for (int i = 0; i < count; ++i) values[i] = function(std::cos(pi * (i + 0.5) / count));
    for (int m = 0; m < count; ++m) {
      for (int i = 0; i < count; ++i) chebyshev[m] += values[i] * std::cos(pi * m * (i + 0.5) / count) * (2.0 / count);
    }
    chebyshev[0] *= 0.5;
    to_powers(chebyshev);
  }
  Fit() = default;

  Complex operator()(double u) const {
    double re = real_[degree], im = imag_[degree];
    for (int m = degree - 1; m >= 0; --m) {
      re = re * u + real_[m];
      im = im * u + imag_[m];
    }
    return {re, im};
  }

 private:
  // T_{m+1} = 2 u T_m - T_{m-1}.
  void to_powers(const std::array<Complex, degree + 1>& chebyshev) {
    std::array<double, degree + 2> before{}, here{};
    before[0] = 1.0;
    here[1] = 1.0;
    add(before, chebyshev[0]);
    for (int m = 1; m <= degree; ++m) {
      add(here, chebyshev[m]);
      std::array<double, degree + 2> next{};
      for (int i = 0; i <= degree; ++i) next[i + 1] = 2 * here[i];
      for (int i = 0; i <= degree + 1; ++i) next[i] -= before[i];
      before = here;
      here = next;
    }
  }

  void add(const std::array<double, degree + 2>& powers, Complex factor) {
    for (int i = 0; i <= degree; ++i) {
      real_[i] += powers[i] * factor.real();
      imag_[i] += powers[i] * factor.imag();
    }
  }

  std::array<double, degree + 1> real_{}, imag_{};
};

constexpr double reach = 6.0;  // beyond it x W(x) is fitted in 1/x^2, in which it is smooth
constexpr int pieces = 48;
constexpr double piece_width = reach / pieces;

Complex exact(double x) { return faddeeva(turn * Complex(0.0, x)); }

struct Table {
  std::array<Fit<9>, pieces> near;
  Fit<14> far;

  Table() {
    for (int i = 0; i < pieces; ++i) near[i] = Fit<9>([&](double u) { return exact((i + 0.5 * (1 + u)) * piece_width); });
    far = Fit<14>([](double u) {
      const double x = reach / std::sqrt(0.5 * (1 + u));
      return x * exact(x);
    });
  }
};

const Table table;

}  // namespace

Complex scaled_erfc(double x) {
  if (x < reach) {
    const double place = x / piece_width;
    const int piece = std::min(static_cast<int>(place), pieces - 1);
    return table.near[piece](2 * (place - piece) - 1);
  }
  const double ratio = reach / x;
  return table.far(2 * ratio * ratio - 1) / x;
}

Complex erf_over(double x, Complex value, Complex decay) {
  if (x > 0.5) return (1.0 - decay * value) / x;
  // Taylor series, z^{2m+1} (-1)^m / (m! (2m+1)): the first term left out is 0.25^12 / (12! 25) = 5e-18.
  const Complex squared(0.0, -x * x);  // -z^2
  Complex sum = 0.0, power = 1.0;
  for (int m = 0; m < 12; ++m) {
    sum += power / (2.0 * m + 1);
    power *= squared / (m + 1.0);
  }
  return 2 * std::numbers::inv_sqrtpi * turn * sum;
}

Complex divided_difference(double a, double b, Complex at_a, Complex at_b) {
  const double apart = a - b, middle = (a + b) / 2;
  if (std::abs(apart) * (1 + middle) > 0.1) return (at_a - at_b) / apart;
  // W' = 2jxW - 2 e^{j pi/4} / sqrt(pi), hence W^(m+1) = 2j (x W^(m) + m W^(m-1)); a difference about its middle has odd
  // derivatives only. The first term left out is below 1e-12 at the switch.
  const Complex j2(0.0, 2.0);
  std::array<Complex, 8> derivative{scaled_erfc(middle)};
  derivative[1] = j2 * middle * derivative[0] - 2 * std::numbers::inv_sqrtpi * turn;
  for (int m = 1; m < 7; ++m) derivative[m + 1] = j2 * (middle * derivative[m] + static_cast<double>(m) * derivative[m - 1]);
  const double squared = apart * apart;
  return derivative[1] +
         squared * (derivative[3] / 24.0 + squared * (derivative[5] / 1920.0 + squared * (derivative[7] / 322560.0)));
}

}  // namespace raytube
