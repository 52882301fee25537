#include "utd/surface/strip_sum.h"

#include <cmath>

namespace raytube {

namespace {

// The integral of x e^{jux} over [-1, 1] is 2j times this.
double odd_moment(double u) { return std::abs(u) < 1e-2 ? u * (1.0 / 3.0 - u * u / 30.0) : (std::sin(u) / u - std::cos(u)) / u; }

}  // namespace

StripSum::StripSum(std::span<const double> wavenumbers, std::span<ScatteringMatrix> sum, std::vector<ImageEdge>* places)
    : wavenumbers_(wavenumbers), sum_(sum), places_(places) {}

ScatteringMatrix StripSum::over_step(std::size_t index, double step, double path, const ScatteringMatrix& amplitude) const {
  const double k = wavenumbers_[index], u = 0.5 * k * (path - path_);
  const Complex phase = 0.5 * step * std::polar(1.0, 0.5 * k * (path + path_));
  const Complex even = phase * sinc(u), odd = phase * Complex(0, odd_moment(u));
  ScatteringMatrix mean = amplitude_[index] + amplitude, rise = amplitude - amplitude_[index];
  return (mean *= even) + (rise *= odd);
}

void StripSum::add(bool first, double step, double path, const dvec3& position, std::span<const ScatteringMatrix> amplitude) {
  for (std::size_t f = 0; !first && f < wavenumbers_.size(); ++f) {
    const ScatteringMatrix s = over_step(f, step, path, amplitude[f]);
    sum_[f] += s;
    if (places_ != nullptr) places_->push_back({0.5 * (position + position_), 0.5 * (position + position_), s});
  }
  path_ = path;
  position_ = position;
  amplitude_.assign(amplitude.begin(), amplitude.end());
}

}  // namespace raytube
