#include "imaging/peak.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace raytube {

namespace {

constexpr std::size_t most_climbs = 32;
constexpr int halvings = 9;  // of a step: a peak is met within a few ten-thousandths of a decibel

int largest_channel(const ScatteringMatrix& s) {
  int largest = 0;
  for (int channel = 1; channel < 4; ++channel)
    if (std::abs(s.at(channel / 2, channel % 2)) > std::abs(s.at(largest / 2, largest % 2))) largest = channel;
  return largest;
}

// Samples that a peak above all of them may be next to: no neighbour is higher, and midway between samples a point reads no less.
std::vector<std::size_t> tops(std::span<const ScatteringMatrix> samples, const std::array<std::size_t, 3>& shape,
                              const dvec3& steps, double density) {
  std::vector<double> levels(samples.size());
  std::ranges::transform(samples, levels.begin(), largest_amplitude);
  double least = std::ranges::max(levels);
  const double half = 0.5 * pi / density;
  for (int axis = 0; axis < 3; ++axis)
    if (steps[axis] > 0.0) least *= std::sin(half) / half;
  const std::array<std::size_t, 3> stride{shape[1] * shape[2], shape[2], 1};
  const auto is_top = [&](std::size_t i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (steps[static_cast<int>(axis)] <= 0.0) continue;
      const std::size_t at = i / stride[axis] % shape[axis];
      if (at > 0 && levels[i - stride[axis]] > levels[i]) return false;
      if (at + 1 < shape[axis] && levels[i + stride[axis]] > levels[i]) return false;
    }
    return true;
  };
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (levels[i] > 0.0 && levels[i] >= least && is_top(i)) found.push_back(i);
  std::ranges::stable_sort(found, std::ranges::greater{}, [&](std::size_t i) { return levels[i]; });
  found.resize(std::min(found.size(), most_climbs));
  return found;
}

GridPeak climbed(std::size_t sample, int channel, const dvec3& steps, const AmplitudeNear& amplitude) {
  GridPeak peak{sample, dvec3(0.0), amplitude(sample, channel, dvec3(0.0))};
  const auto rises = [&](int axis, double step) {
    dvec3 offset = peak.offset;
    offset[axis] += step;
    if (std::abs(offset[axis]) > steps[axis]) return false;
    const double level = amplitude(sample, channel, offset);
    if (!(level > peak.amplitude)) return false;
    peak = {sample, offset, level};
    return true;
  };
  double share = 0.5;
  for (int i = 0; i < halvings; ++i, share *= 0.5)
    for (bool higher = true; higher;) {
      higher = false;
      for (int axis = 0; axis < 3; ++axis)
        if (const double step = share * steps[axis]; step > 0.0) higher = rises(axis, step) || rises(axis, -step) || higher;
    }
  return peak;
}

}  // namespace

GridPeak highest_peak(std::span<const ScatteringMatrix> samples, const std::array<std::size_t, 3>& shape, const dvec3& steps,
                      double density, const AmplitudeNear& amplitude) {
  const std::vector<std::size_t> from = tops(samples, shape, steps, density);
  if (from.empty()) return {};
  std::vector<GridPeak> peaks(from.size());
  tbb::parallel_for(std::size_t{0}, from.size(),
                    [&](std::size_t i) { peaks[i] = climbed(from[i], largest_channel(samples[from[i]]), steps, amplitude); });
  return *std::ranges::max_element(peaks, {}, &GridPeak::amplitude);
}

}  // namespace raytube
