#include "math/path_bins.h"

#include <cmath>
#include <limits>

#include "math/node_waves.h"

namespace raytube {

namespace {

constexpr double bin_error = 1e-6;   // of the sum of all amplitudes, as a bound; what is met is a hundredth of it
constexpr double least_reach = 3.0;  // half of what a bin may span, in radians; with less there are more bins than points
constexpr double own_spread = 1.0;   // of that, what a wave may span by itself

}  // namespace

PathBins::PathBins(Band& band, bool interpolate)
    : wavenumbers_(band.wavenumbers()), at_(wavenumbers_), spread_(std::numeric_limits<double>::infinity()) {
  const Band::SlowNodes slow = interpolate ? band.slow_nodes(least_reach, bin_error) : Band::SlowNodes{};
  if (slow.nodes == nullptr) return;
  nodes_ = slow.nodes;
  at_ = nodes_->at;
  spread_ = slow.half_span * own_spread / least_reach;
  width_ = 2.0 * (slow.half_span - spread_);
}

std::int64_t PathBins::key(double path) const { return width_ > 0.0 ? static_cast<std::int64_t>(std::floor(path / width_)) : 0; }

std::size_t PathBins::find(double path) {
  const auto [entry, is_new] = index_.try_emplace(key(path), keys_.size());
  return is_new ? append(entry->first) : entry->second;
}

std::size_t PathBins::append(std::int64_t key) {
  keys_.push_back(key);
  values_.resize(values_.size() + at_.size());
  return keys_.size() - 1;
}

void PathBins::move_to(std::span<ScatteringMatrix> sums) {
  for (std::size_t bin = 0; bin < keys_.size(); ++bin) expand(bin, sums);
  index_.clear();
  keys_.clear();
  values_.clear();
}

void PathBins::expand(std::size_t bin, std::span<ScatteringMatrix> sums) const {
  const std::span<const ScatteringMatrix> values = std::span(values_).subspan(bin * at_.size(), at_.size());
  if (nodes_ != nullptr) return add_interpolated(values, *nodes_, wavenumbers_, middle(bin), sums);
  for (std::size_t f = 0; f < sums.size(); ++f) sums[f] += values[f];
}

}  // namespace raytube
