#include "math/path_bins.h"

#include <bit>
#include <cmath>
#include <limits>

#include "math/lanes.h"

namespace raytube {

namespace {

constexpr double bin_error = 1e-6;   // of the sum of all amplitudes, as a bound; what is met is a hundredth of it
constexpr double least_reach = 3.0;  // half of what a bin may span, in radians; with less there are more bins than points
constexpr double own_spread = 1.0;   // of that, what a wave may span by itself

/// All eight numbers of a matrix alike.
ScatteringMatrix interpolated(std::span<const ScatteringMatrix> values, const double* weight) {
  std::array<double, 8> sum{};
  for (const ScatteringMatrix& value : values) {
    const auto* numbers = reinterpret_cast<const double*>(&value);
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += *weight * numbers[c];
    ++weight;
  }
  return std::bit_cast<ScatteringMatrix>(sum);
}

}  // namespace

PathBins::PathBins(Band& band, bool interpolate)
    : wavenumbers_(band.wavenumbers()), nodes_(wavenumbers_), spread_(std::numeric_limits<double>::infinity()) {
  const Band::SlowNodes slow = interpolate ? band.slow_nodes(least_reach, bin_error) : Band::SlowNodes{};
  if (slow.nodes == nullptr) return;
  nodes_ = slow.nodes->at;
  weights_ = slow.nodes->weights;
  spread_ = slow.half_span * own_spread / least_reach;
  width_ = 2.0 * (slow.half_span - spread_);
}

std::int64_t PathBins::key(double path) const { return width_ > 0.0 ? static_cast<std::int64_t>(std::floor(path / width_)) : 0; }

std::size_t PathBins::find(double path) {
  const auto [entry, is_new] = index_.try_emplace(key(path), keys_.size());
  if (is_new) {
    keys_.push_back(entry->first);
    values_.resize(values_.size() + nodes_.size());
  }
  return entry->second;
}

void PathBins::move_to(std::span<ScatteringMatrix> sums) {
  for (std::size_t bin = 0; bin < keys_.size(); ++bin) expand(bin, sums);
  index_.clear();
  keys_.clear();
  values_.clear();
}

void PathBins::expand(std::size_t bin, std::span<ScatteringMatrix> sums) {
  const std::span<ScatteringMatrix> values = std::span(values_).subspan(bin * nodes_.size(), nodes_.size());
  if (weights_.empty()) {
    for (std::size_t f = 0; f < sums.size(); ++f) sums[f] += values[f];
    return;
  }
  const double middle = (static_cast<double>(keys_[bin]) + 0.5) * width_;
  for (std::size_t n = 0; n < nodes_.size(); ++n) values[n] *= std::polar(1.0, -nodes_[n] * middle);
  for (std::size_t first = 0; first < sums.size(); first += lanes) {
    Reals angle{};
    const std::size_t count = std::min(lanes, sums.size() - first);
    for (std::size_t i = 0; i < count; ++i) angle[i] = middle * wavenumbers_[first + i];
    const Complexes phasors = unit_phasors(angle);
    for (std::size_t i = 0; i < count; ++i)
      sums[first + i] += interpolated(values, weights_.data() + (first + i) * nodes_.size()) *= phasors[i];
  }
}

}  // namespace raytube
