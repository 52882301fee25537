#include "utd/impedance/maliuzhinets.h"

#include <cmath>

namespace raytube {

namespace {

// The poles at s = j/n leave e^{-50} of the sum, for |Im z| < 28 still e^{-36}; what lies beyond n s = 12.75 is e^{-40}.
constexpr double step_by_n = 0.125;
constexpr int nodes = 102;

}  // namespace

MaliuzhinetsFunction::MaliuzhinetsFunction(double n) : n_(n), step_(step_by_n / n) {
  for (int i = 1; i <= nodes; ++i) {
    const double s = i * step_;
    weights_.push_back(-0.5 * step_ / (s * std::cosh(0.5 * pi * s) * std::sinh(n * pi * s)));
  }
  at_right_angle_ = exponent(pi / 2);
}

// cosh of the multiples by cosh((i+1)x) = 2 cosh x cosh ix - cosh((i-1)x); at s = 0 the integrand is z^2 / (2 n pi).
Complex MaliuzhinetsFunction::exponent(Complex z) const {
  const Complex twice = 2.0 * std::cosh(z * step_);
  Complex before = 1.0, at = 0.5 * twice, sum = -0.125 * step_ / (n_ * pi) * z * z;
  for (const double weight : weights_) {
    sum += weight * (at - 1.0);
    const Complex next = twice * at - before;
    before = at, at = next;
  }
  return sum;
}

Complex MaliuzhinetsFunction::operator()(Complex z) const {
  if (z.real() < 0.0) z = -z;
  if (z.real() > pi / 2) return std::cos((z - pi / 2) / (2 * n_)) / (*this)(z - pi);
  return std::exp(exponent(z) - at_right_angle_);
}

}  // namespace raytube
