#include "utd/impedance/maliuzhinets.h"

#include <cmath>
#include <numeric>

namespace raytube {

// The poles at s = j/n leave e^{-2 pi / step_by_n} of the sum, e^{|Im z| / n} times that away from the real axis: so the step is
// for 1.4 times the digits. The terms of a pair at |Re w| = |Re a| = pi/2 fall like e^{-(n pi - pi/2) s}.
MaliuzhinetsFunction::MaliuzhinetsFunction(double n, double digits)
    : n_(n), step_(2 * pi / (1.4 * digits * n)), at_zero_(-0.125 * step_ / (n * pi)) {
  const int nodes = static_cast<int>(std::ceil(digits / ((n - 0.5) * pi * step_)));
  right_angle_ = at_zero_ * pi * pi / 4;
  for (int i = 1; i <= nodes; ++i) {
    const double s = i * step_;
    weights_.push_back(-0.5 * step_ / (s * std::cosh(0.5 * pi * s) * std::sinh(n * pi * s)));
    right_angle_ += weights_.back() * (std::cosh(0.5 * pi * s) - 1.0);
  }
}

// By cosh((i+1)x) = 2 cosh x cosh ix - cosh((i-1)x).
std::vector<Complex> MaliuzhinetsFunction::waves(Complex z) const {
  std::vector<Complex> result(weights_.size());
  const Complex once = std::cosh(z * step_);
  const double re = 2.0 * once.real(), im = 2.0 * once.imag();
  Complex before = 1.0, at = once;
  for (Complex& wave : result) {
    wave = at;
    at = {re * wave.real() - im * wave.imag() - before.real(), re * wave.imag() + im * wave.real() - before.imag()};
    before = wave;
  }
  return result;
}

MaliuzhinetsPoint MaliuzhinetsFunction::point(Complex w) const {
  MaliuzhinetsPoint result{w, {}, {}, {}};
  if (w.real() < 0.0) w = -w;
  for (; w.real() > pi / 2; w -= pi) result.turns.push_back(std::cos((w - pi / 2) / n_));
  result.square = 2.0 * at_zero_ * w * w;
  result.waves = waves(w);
  return result;
}

MaliuzhinetsPair::MaliuzhinetsPair(const MaliuzhinetsFunction& psi, Complex a)
    : waves_(psi.waves(a)),
      constant_(2.0 * (psi.at_zero_ * a * a - std::accumulate(psi.weights_.begin(), psi.weights_.end(), psi.right_angle_))),
      turn_(std::cos(a / psi.n_)) {
  for (std::size_t i = 0; i < waves_.size(); ++i) waves_[i] *= 2.0 * psi.weights_[i];
}

Complex MaliuzhinetsPair::operator()(const MaliuzhinetsPoint& w) const {
  double re = 0.0, im = 0.0;
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const Complex one = waves_[i], other = w.waves[i];
    re += one.real() * other.real() - one.imag() * other.imag();
    im += one.real() * other.imag() + one.imag() * other.real();
  }
  Complex product = std::exp(Complex(re, im) + w.square + constant_);
  for (std::size_t i = w.turns.size(); i > 0; --i) product = 0.5 * (w.turns[i - 1] + turn_) / product;
  return product;
}

}  // namespace raytube
