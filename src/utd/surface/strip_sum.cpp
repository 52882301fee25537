#include "utd/surface/strip_sum.h"

#include <cmath>

#include "math/filon.h"

namespace raytube {

namespace {

// What the amplitudes at a step's two ends count for in its mean, of roots |a| and |b| of a linear width: 1 each where these are
// about the same.
std::array<double, 2> shares_in_mean(double a, double b) {
  const double sum = std::abs(a) + std::abs(b);
  if (sum <= 0.0) return {1.0, 1.0};
  if (a * b < 0.0) return {4.0 / 3.0 * std::abs(a) / sum, 4.0 / 3.0 * std::abs(b) / sum};
  const double product = std::sqrt(a * b), both = 4.0 / 3.0 * (sum + product) / (sum + 2.0 * product);
  return {both, both};
}

}  // namespace

void StripSum::add_step(double step, double path, const dvec3& middle, const std::array<double, 2>& shares,
                        std::span<const ScatteringMatrix> amplitude) {
  const BandSum::Bin bin = sum_.bin(0.5 * (path + path_), half_span_);
  for (std::size_t f = 0; f < bin.at.size(); ++f) {
    const double phase_from = bin.at[f] * (path_ - bin.path), phase_to = bin.at[f] * (path - bin.path);
    const FilonStep filon = filon_step(phase_from, phase_to, std::polar(1.0, phase_from), std::polar(1.0, phase_to));
    ScatteringMatrix from = amplitude_[f], to = amplitude[f];
    const ScatteringMatrix s =
        (from *= step * (shares[0] * filon.even - filon.odd)) + (to *= step * (shares[1] * filon.even + filon.odd));
    bin.sum[f] += s;
    if (places_ == nullptr || places_->wavenumber != f) continue;
    const dvec3 place = places_->by_path ? places_->by_path->at(start_, middle, 0.5 * (path + path_)) : middle;
    places_->pieces.push_back({place, place, s});
  }
}

void StripSum::add(bool first, double step, double path, const dvec3& position, double width,
                   std::span<const ScatteringMatrix> amplitude) {
  if (first)
    start_ = position;
  else
    add_step(step, path, 0.5 * (position + position_), shares_in_mean(width_, width), amplitude);
  path_ = path;
  width_ = width;
  position_ = position;
  amplitude_.assign(amplitude.begin(), amplitude.end());
}

}  // namespace raytube
