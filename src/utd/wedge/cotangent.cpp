#include "utd/wedge/cotangent.h"

#include <cmath>

namespace raytube {

// cot(x + jy) = (sin x cos x - j sinh y cosh y) / (sin^2 x + sinh^2 y).
Complex cotangent(Complex z) {
  if (std::abs(z.imag()) > 20.0) return {0.0, std::copysign(1.0, -z.imag())};  // to rounding; sinh^2 would overflow later
  const double sine = std::sin(z.real()), hyperbolic = std::sinh(z.imag());
  return Complex(sine * std::cos(z.real()), -hyperbolic * std::cosh(z.imag())) / (sine * sine + hyperbolic * hyperbolic);
}

Complex cotangent_difference(double n, Complex x) {
  if (std::abs(x.real()) + std::abs(x.imag()) < series_below) return x * difference_over_argument(n, x * x);
  return wedge_cotangent(n, x) - cotangent(x / 2.0);
}

}  // namespace raytube
