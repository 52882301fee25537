#include "utd/transition.h"

#include <array>
#include <cmath>

namespace raytube {

namespace {

constexpr int terms = 32;  // error of w(z) on the ray used by transition(): 7e-12 with 24 terms, rounding with 32

/// Weideman (1994), SIAM J. Numer. Anal. 31, 1497 (his program cef): w(z) is a polynomial in Z = (L + jz)/(L - jz) whose
/// coefficients are Fourier coefficients of e^{-t^2} (L^2 + t^2), t = L tan(theta/2). Valid for Im z >= 0.
struct RationalExpansion {
  double scale = std::sqrt(terms / std::numbers::sqrt2);  // L
  std::array<double, terms> coefficients{};               // of Z^0, Z^1, ...

  RationalExpansion() {
    for (int order = 1; order <= terms; ++order) coefficients[order - 1] = fourier_coefficient(order);
  }

  double fourier_coefficient(int order) const {
    constexpr int half = 2 * terms;
    double sum = scale * scale;
    for (int sample = 1; sample < half; ++sample) {
      const double angle = sample * pi / half;
      const double t = scale * std::tan(angle / 2);
      sum += 2 * std::exp(-t * t) * (scale * scale + t * t) * std::cos(order * angle);
    }
    return sum / (2 * half);
  }
};

}  // namespace

Complex faddeeva(Complex z) {
  static const RationalExpansion expansion;  // made at first use: other tables are fitted to it before main() starts
  const Complex jz(-z.imag(), z.real());
  const Complex inverse = 1.0 / (expansion.scale - jz);
  const Complex ratio = (expansion.scale + jz) * inverse;
  Complex polynomial = 0.0;
  for (int power = terms - 1; power >= 0; --power) polynomial = polynomial * ratio + expansion.coefficients[power];
  return (2.0 * polynomial * inverse + std::numbers::inv_sqrtpi) * inverse;
}

Complex transition(double x) {
  // F(X) = sqrt(pi) z e^{z^2} erfc(z) = sqrt(pi) z w(jz) with z = e^{j pi/4} sqrt(X): an identity of the definition.
  const double side = std::sqrt(std::abs(x) / 2);
  const Complex value = std::sqrt(pi) * Complex(side, side) * faddeeva(Complex(-side, side));
  return x < 0 ? std::conj(value) : value;
}

}  // namespace raytube
