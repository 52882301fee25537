#include "utd/surface/strip_sum.h"

#include "math/filon.h"

namespace raytube {

void StripSum::add_step(double step, double path, const dvec3& middle, std::span<const ScatteringMatrix> amplitude) {
  const BandSum::Bin bin = sum_.bin(0.5 * (path + path_), half_span_);
  for (std::size_t f = 0; f < bin.at.size(); ++f) {
    const FilonStep filon = filon_step(bin.at[f] * (path_ - bin.path), bin.at[f] * (path - bin.path));
    ScatteringMatrix both = amplitude_[f] + amplitude[f], rise = amplitude[f] - amplitude_[f];
    const ScatteringMatrix s = (both *= step * filon.even) + (rise *= step * filon.odd);
    bin.sum[f] += s;
    if (places_ == nullptr || places_->wavenumber != f) continue;
    const dvec3 place = places_->by_path ? places_->by_path->at(start_, middle, 0.5 * (path + path_)) : middle;
    places_->pieces.push_back({place, place, s});
  }
}

void StripSum::add(bool first, double step, double path, const dvec3& position, std::span<const ScatteringMatrix> amplitude) {
  if (first)
    start_ = position;
  else
    add_step(step, path, 0.5 * (position + position_), amplitude);
  path_ = path;
  position_ = position;
  amplitude_.assign(amplitude.begin(), amplitude.end());
}

}  // namespace raytube
