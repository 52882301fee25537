#include "utd/surface/strip_sum.h"

#include "math/filon.h"

namespace raytube {

StripSum::StripSum(std::span<const double> wavenumbers, std::span<ScatteringMatrix> sum, StripPlaces* places)
    : wavenumbers_(wavenumbers), sum_(sum), places_(places) {}

ScatteringMatrix StripSum::over_step(std::size_t index, double step, double path, const ScatteringMatrix& amplitude) const {
  const FilonStep filon = filon_step(wavenumbers_[index] * path_, wavenumbers_[index] * path);
  ScatteringMatrix sum = amplitude_[index] + amplitude, rise = amplitude - amplitude_[index];
  return (sum *= step * filon.even) + (rise *= step * filon.odd);
}

void StripSum::add(bool first, double step, double path, const dvec3& position, std::span<const ScatteringMatrix> amplitude) {
  for (std::size_t f = 0; !first && f < wavenumbers_.size(); ++f) {
    const ScatteringMatrix s = over_step(f, step, path, amplitude[f]);
    sum_[f] += s;
    const dvec3 middle = 0.5 * (position + position_);
    if (places_ != nullptr && places_->wavenumber == f) places_->pieces.push_back({middle, middle, s});
  }
  path_ = path;
  position_ = position;
  amplitude_.assign(amplitude.begin(), amplitude.end());
}

}  // namespace raytube
