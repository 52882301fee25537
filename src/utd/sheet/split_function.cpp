#include "utd/sheet/split_function.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

Complex tilted_root(Complex z, double tilt) {
  const double half = pi / 4 - tilt / 2;
  return std::polar(1.0, half) * std::sqrt(z * std::polar(1.0, -2 * half));
}

}  // namespace

Complex sheet_root(Complex a, double tilt) { return -imaginary_unit * tilted_root(a - 1.0, tilt) * std::sqrt(a + 1.0); }

SplitFunction::SplitFunction(SheetChannel channel, Complex constant, Complex quadratic)
    : channel_(channel), constant_(constant), quadratic_(quadratic) {
  // The integral is over u, t = sinh u, as the integrand is regular for |Im u| < pi/2.
  constexpr double step = 0.05;
  double turns = 0.0, last = 0.0;
  for (double u = 0.0; u < 24.0; u += step) {
    const double t = std::sinh(u), cosh = std::cosh(u);
    const Complex value = std::log(kernel(cosh, imaginary_unit * t));
    if (u > 0.0) turns -= 2 * pi * std::round((value.imag() - last) / (2 * pi));
    last = value.imag();
    node_.push_back(t);
    weight_.push_back((u == 0.0 ? 0.5 : 1.0) * step * cosh / pi);
    real_.push_back(value.real());
    imaginary_.push_back(value.imag() + turns);
  }
}

Complex SplitFunction::kernel(Complex s, Complex a) const {
  return channel_ == SheetChannel::curl ? 2.0 * s + admittance(a) : 2.0 + s * admittance(a);
}

// A constant may be taken out of the logarithm: g gives g / 2. Near the nodes, or near 0, that is ln Q(a) itself, so that nothing
// is singular at t = +-ja.
Complex SplitFunction::logarithm_near(Complex a) const {
  const bool near = std::abs(a) < 0.7 || a.real() < 0.5 * std::abs(a);
  if (!near) return {real_[0], imaginary_[0]};
  const Complex value = std::log(kernel(std::sqrt(1.0 - a * a), a));
  const auto node = std::ranges::lower_bound(node_, std::abs(a.imag()));
  const double turn = imaginary_[std::min<std::size_t>(node - node_.begin(), node_.size() - 1)];
  return {value.real(), value.imag() + 2 * pi * std::round((turn - value.imag()) / (2 * pi))};
}

Complex SplitFunction::logarithm(Complex a) const {
  const Complex apart = logarithm_near(a), square = a * a;
  const double square_real = square.real(), square_imaginary = square.imag();
  double sum_real = 0.0, sum_imaginary = 0.0;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    const double distance = node_[i] * node_[i] + square_real;
    const double norm = distance * distance + square_imaginary * square_imaginary + 1e-28, weight = weight_[i] / norm;
    const double real = real_[i] - apart.real(), imaginary = imaginary_[i] - apart.imag();
    sum_real += weight * (real * distance + imaginary * square_imaginary);
    sum_imaginary += weight * (imaginary * distance - real * square_imaginary);
  }
  return 0.5 * apart + a * Complex(sum_real, sum_imaginary);
}

Complex SplitFunction::at(Complex a) const {
  Complex factor = std::exp(logarithm(a.real() < 0.0 ? -a : a));
  if (a.real() < 0.0) factor = kernel(sheet_root(a), a) / factor;
  return channel_ == SheetChannel::curl ? std::sqrt(1.0 + a) / factor : 1.0 / factor;
}

std::vector<Complex> SplitFunction::guided(double slowest, double tilt) const {
  std::vector<Complex> roots;  // those in s
  if (channel_ == SheetChannel::divergence) {
    roots = {-2.0 / constant_};
  } else if (std::abs(quadratic_) <= 1e-12 * std::abs(constant_)) {
    roots = {-constant_ / 2.0};
  } else {  // -quadratic s^2 + 2 s + constant + quadratic = 0, without the difference of large numbers
    const Complex sum = constant_ + quadratic_, root = std::sqrt(1.0 + quadratic_ * sum);
    const Complex larger = root.real() >= 0.0 ? 1.0 + root : 1.0 - root;
    roots = {larger / quadratic_, -sum / larger};
  }
  std::vector<Complex> waves;
  for (const Complex& s : roots)
    for (const double sign : {1.0, -1.0}) {
      const Complex a = sign * std::sqrt(1.0 - s * s);
      if (a.real() <= 0.0 || a.imag() > 1e-14 || std::abs(a) >= slowest) continue;
      if (std::abs(sheet_root(a + 1e-12 * imaginary_unit, tilt) - s) < 1e-6 * std::max(1.0, std::abs(s)))
        waves.push_back(a - 1e-15 * imaginary_unit);
    }
  return waves;
}

Complex SplitFunction::residue(Complex a, double tilt) const {
  const Complex s = sheet_root(a, tilt);
  if (channel_ == SheetChannel::curl) return s / (-2.0 * a / s + 2.0 * quadratic_ * a);
  return 1.0 / (-a / s * admittance(a) + 2.0 * s * quadratic_ * a);
}

Complex SplitFunction::jump(Complex a) const {
  const Complex s = std::sqrt(1.0 - a * a), y = admittance(a);
  return channel_ == SheetChannel::curl ? -2.0 * s * y / (y * y - 4.0 * s * s) : 2.0 * s * y / (4.0 - s * s * y * y);
}

}  // namespace raytube
