#include "imaging/range_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "core/error.h"
#include "imaging/fourier.h"
#include "imaging/peak.h"

namespace raytube {

namespace {

// The mean over frequencies, weighted: what a profile has where all of it is at one range.
ChannelErrors mean(const SweepSamples& samples, std::size_t look, const std::vector<ChannelErrors>& errors,
                   const std::vector<double>& weights) {
  ChannelErrors sum{};
  for (std::size_t f = 0; f < weights.size(); ++f)
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = 0; q < 2; ++q) sum[p][q] += weights[f] * errors[samples.row(look, f)][p][q];
  return sum;
}

// One look, one channel.
class Profile {
 public:
  Profile(const SweepSamples& samples, const EvenAxis& range, const std::vector<double>& weights)
      : samples_(samples), range_(range), weights_(weights), data_(range.count) {}

  // With the phases of the first range taken out of the transform, and of the lowest frequency put into it.
  void make(std::size_t look, int p, int q, std::span<ScatteringMatrix> result) {
    std::ranges::fill(data_, 0.0);
    for (std::size_t f = 0; f < weights_.size(); ++f)
      data_[f] = weights_[f] * samples_.s[samples_.row(look, f)].at(p, q) *
                 std::polar(1.0, 2.0 * samples_.wavenumber_at(f) * range_.first);
    fourier_transform(data_, std::array{data_.size()}, samples_.frequency.step > 0.0 ? 1 : -1);
    const double k = samples_.wavenumber_at(0);
    for (std::size_t i = 0; i < data_.size(); ++i)
      result[i].at(p, q) = data_[i] * std::polar(1.0, 2.0 * k * range_.step * static_cast<double>(i));
  }

 private:
  const SweepSamples& samples_;
  const EvenAxis& range_;
  const std::vector<double>& weights_;
  std::vector<Complex> data_;
};

// |p| of one look and channel at any range.
double amplitude_at(const SweepSamples& samples, const std::vector<double>& weights, std::size_t look, int channel,
                    double range) {
  Complex sum = 0.0;
  for (std::size_t f = 0; f < weights.size(); ++f)
    sum += samples.s[samples.row(look, f)].at(channel / 2, channel % 2) *
           std::polar(weights[f], 2.0 * samples.wavenumber_at(f) * range);
  return std::abs(sum);
}

RangePeak peak_of(const SweepSamples& samples, const std::vector<double>& weights, const RangeProfiles& profiles) {
  const EvenAxis& range = profiles.range;
  const auto amplitude = [&](std::size_t i, int channel, const dvec3& offset) {
    return amplitude_at(samples, weights, i / range.count, channel, range.at(i % range.count) + offset.z);
  };
  const GridPeak peak = highest_peak(profiles.s, {1, samples.looks.size(), range.count}, {0.0, 0.0, range.step},
                                     profiles.limits.cell / range.step, amplitude);
  return {peak.sample / range.count, range.at(peak.sample % range.count) + peak.offset.z, peak.amplitude};
}

}  // namespace

AxisLimits axis_limits(double unambiguous, std::size_t count, const Window& window) {
  const double cell = unambiguous / static_cast<double>(count);
  return {cell, cell * peak_width(weights(window, count)), unambiguous};
}

AxisLimits range_limits(const EvenAxis& frequency, const Window& window) {
  return axis_limits(0.5 * speed_of_light / std::abs(frequency.step), frequency.count, window);
}

double frequency_step_for(double depth) { return 0.5 * speed_of_light / depth; }

void require_band(const SweepSamples& samples, const std::string& what) {
  if (samples.frequency.count < 2)
    throw InputError(
        fmt::format("{} has one frequency; a range profile needs a band of B for a resolution of c/2B: 1.5 GHz for 0.1 m", what));
}

RangeProfiles range_profiles(const SweepSamples& samples, const ProfileOptions& options) {
  const EvenAxis& frequency = samples.frequency;
  RangeProfiles result{.limits = range_limits(frequency, options.window)};
  std::vector<double> weight = weights(options.window, frequency.count);
  const double all = std::accumulate(weight.begin(), weight.end(), 0.0);
  for (double& each : weight) each /= all;
  const std::size_t count = fast_size(static_cast<std::size_t>(options.padding) * frequency.count);
  result.range = {options.middle - 0.5 * result.limits.unambiguous, result.limits.unambiguous / static_cast<double>(count),
                  count};
  result.s.resize(samples.looks.size() * count);
  Profile profile(samples, result.range, weight);
  for (std::size_t look = 0; look < samples.looks.size(); ++look) {
    for (const int channel : {0, 1, 2, 3})
      profile.make(look, channel / 2, channel % 2, std::span(result.s).subspan(look * count, count));
    result.error.push_back(mean(samples, look, samples.error, weight));
    result.model.push_back(mean(samples, look, samples.model, weight));
  }
  result.peak = peak_of(samples, weight, result);
  return result;
}

}  // namespace raytube
