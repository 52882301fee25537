#include "imaging/doppler.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "core/error.h"
#include "imaging/fourier.h"
#include "imaging/isar.h"
#include "imaging/peak.h"

namespace raytube {

namespace {

std::vector<double> unit_weights(const Window& window, std::size_t count) {
  std::vector<double> result = weights(window, count);
  const double all = std::accumulate(result.begin(), result.end(), 0.0);
  for (double& each : result) each /= all;
  return result;
}

AxisLimits velocity_limits(double frequency, const EvenAxis& time, std::size_t count, const Window& window) {
  return axis_limits(0.5 * wavelength(frequency) / std::abs(time.step), count, window);
}

// Points (i - count / 2) step about a middle.
EvenAxis about(double middle, double step, std::size_t count) {
  return {middle - static_cast<double>(count / 2) * step, step, count};
}

// Looks of a pulse that make an array, in even steps along it; of a single one the step is 0.
struct LookArray {
  std::size_t count = 1;
  double step = 0.0;  // [m]
  dvec3 along{0.0};   // unit

  double at(std::size_t i) const { return step * (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)); }
};

// Samples over some pulses, from the first of them on, of one look or an array, and where these lie in M.
class PulseSamples {
 public:
  PulseSamples(const SweepSamples& samples, std::size_t looks, const EvenAxis& time, std::size_t count, const LookArray& array,
               const Window& window)
      : samples_(samples),
        looks_(looks),
        array_(array),
        of_pulse_(unit_weights(window, count)),
        of_look_(unit_weights(window, array.count)),
        of_frequency_(unit_weights(window, samples.frequency.count)) {
    for (std::size_t n = 0; n < count; ++n)
      times_.push_back(time.step * (static_cast<double>(n) - 0.5 * static_cast<double>(count - 1)));
    for (const double t : times_)
      for (std::size_t e = 0; e < array.count; ++e)
        for (std::size_t f = 0; f < samples.frequency.count; ++f)
          wave_vectors_.push_back(samples.wavenumber_at(f) * dvec3(-2.0, 2.0 * t, array.at(e)));
  }

  std::span<const dvec3> wave_vectors() const { return wave_vectors_; }
  const std::vector<double>& of_frequency() const { return of_frequency_; }

  /// M of one channel over a grid about a middle.
  std::vector<Complex> focused(const GriddedTransform& transform, std::size_t first, std::size_t look, int channel,
                               const dvec3& middle) const {
    std::vector<Complex> values;
    values.reserve(wave_vectors_.size());
    for_each_look(first, look, [&](std::size_t row, double weight, double path, double, double) {
      for (std::size_t f = 0; f < of_frequency_.size(); ++f)
        values.push_back(samples_.s[row + f].at(channel / 2, channel % 2) *
                         std::polar(weight * of_frequency_[f],
                                    -samples_.wavenumber_at(f) * path - glm::dot(wave_vectors_[values.size()], middle)));
    });
    return transform(values);
  }

  /// |M| of one channel at any range, velocity and cosine. The phases of a look are in even steps.
  double amplitude_at(std::size_t first, std::size_t look, int channel, const dvec3& at) const {
    Complex sum = 0.0;
    for_each_look(first, look, [&](std::size_t row, double weight, double path, double t, double place) {
      const double length = 2.0 * (at.x - at.y * t) - at.z * place - path;
      Complex phase = std::polar(weight, samples_.wavenumber_at(0) * length);
      const Complex step = std::polar(1.0, wavenumber(samples_.frequency.step) * length);
      for (std::size_t f = 0; f < of_frequency_.size(); ++f, phase *= step)
        sum += of_frequency_[f] * phase * samples_.s[row + f].at(channel / 2, channel % 2);
    });
    return std::abs(sum);
  }

 private:
  // visit(first row, weight, path to the origin beyond that in the middle of pulses and array, time, place along the array).
  template <class Visit>
  void for_each_look(std::size_t first, std::size_t look, const Visit& visit) const {
    const std::size_t pulse = times_.size() - 1, element = array_.count - 1;
    const double middle =
        0.5 * (path_of(first + pulse / 2, look + element / 2) + path_of(first + (pulse + 1) / 2, look + (element + 1) / 2));
    for (std::size_t n = 0; n < times_.size(); ++n)
      for (std::size_t e = 0; e < array_.count; ++e)
        visit(samples_.row((first + n) * looks_ + look + e, 0), of_pulse_[n] * of_look_[e], path_of(first + n, look + e) - middle,
              times_[n], array_.at(e));
  }

  // The path to the origin, which the phase of S is without.
  double path_of(std::size_t pulse, std::size_t look) const {
    const SweepLook& at = samples_.looks[pulse * looks_ + look];
    return at.far() ? 0.0 : at.transmit_range + at.receive_range;
  }

  const SweepSamples& samples_;
  std::size_t looks_;
  LookArray array_;
  std::vector<double> times_, of_pulse_, of_look_, of_frequency_;  // times from the middle of the pulses
  std::vector<dvec3> wave_vectors_;                                // of range, velocity and cosine, pulses slowest
};

EvenAxis even_times(const PulseGrid& pulses, const std::string& what) {
  return even_axis(pulses.times, what + ": times of pulses", "s");
}

std::vector<std::size_t> looks_shown(const PulseGrid& pulses, const DopplerOptions& options, const std::string& what) {
  if (options.look && *options.look >= pulses.looks)
    throw InputError(
        fmt::format("{}: a pulse has no look {}, but {}, counted from 0; choose among these", what, *options.look, pulses.looks));
  if (options.look) return {*options.look};
  std::vector<std::size_t> looks(pulses.looks);
  std::iota(looks.begin(), looks.end(), std::size_t{0});
  return looks;
}

void require_cells(double cells, const std::string& what) {
  if (!(cells <= static_cast<double>(most_image_cells)))
    throw InputError(fmt::format("{}: a map of {:g} cells, more than {}; ask for less padding, or for fewer pulses", what, cells,
                                 most_image_cells));
}

DopplerPeak peak_of(const PulseSamples& pulses, const DopplerMap& map, double padding) {
  const std::array<const EvenAxis*, 3> axes{&map.range, &map.velocity, &map.cosine};
  const std::array shape{map.range.count, map.velocity.count, map.cosine.count};
  const std::size_t cells = shape[0] * shape[1] * shape[2];
  dvec3 steps(0.0);
  for (int axis = 0; axis < 3; ++axis)
    if (axes[axis]->count > 1) steps[axis] = axes[axis]->step;
  const auto place = [&](std::size_t sample, const dvec3& offset) {
    return offset + dvec3(map.range.at(sample / shape[2] / shape[1]), map.velocity.at(sample / shape[2] % shape[1]),
                          map.cosine.at(sample % shape[2]));
  };
  DopplerPeak best;
  for (std::size_t i = 0; i < map.looks.size(); ++i) {
    const GridPeak peak = highest_peak(std::span(map.s).subspan(i * cells, cells), shape, steps, padding,
                                       [&](std::size_t sample, int channel, const dvec3& offset) {
                                         return pulses.amplitude_at(0, map.looks[i], channel, place(sample, offset));
                                       });
    const dvec3 at = place(peak.sample, peak.offset);
    if (i == 0 || peak.amplitude > best.amplitude) best = {map.looks[i], at.x, at.y, at.z, peak.amplitude};
  }
  return best;
}

// |p|^2 of a point over ranges beside it.
double power_of_point(const SweepSamples& samples, const std::vector<double>& of_frequency, const EvenAxis& range) {
  double power = 0.0;
  for (std::size_t i = 0; i < range.count; ++i) {
    Complex sum = 0.0;
    for (std::size_t f = 0; f < of_frequency.size(); ++f)
      sum += std::polar(of_frequency[f], 2.0 * samples.wavenumber_at(f) * (range.at(i) - range.at(range.count / 2)));
    power += std::norm(sum);
  }
  return power;
}

// Ranges of a gate, as many to either side of the middle; of one frequency there is one.
EvenAxis gated(const SweepSamples& samples, const SpectrogramOptions& options) {
  if (samples.frequency.count < 2) return {};
  const AxisLimits limits = range_limits(samples.frequency, options.window);
  const double step = limits.cell / options.padding,
               width = std::min(options.gate.value_or(limits.unambiguous), limits.unambiguous);
  const auto all = static_cast<std::size_t>(options.padding) * samples.frequency.count;
  return about(options.range, step, std::min(all, 1 + 2 * static_cast<std::size_t>(0.5 * width / step)));
}

double doppler(double velocity, double frequency) { return 2.0 * velocity / wavelength(frequency); }

}  // namespace

PulseGrid pulse_grid(const std::vector<double>& times, const std::string& what) {
  if (times.empty()) throw InputError(what + ": nothing moves, its looks have no times; give the case [motion] with its pulses");
  PulseGrid pulses;
  pulses.looks =
      static_cast<std::size_t>(std::ranges::find_if(times, [&](double t) { return t != times.front(); }) - times.begin());
  for (std::size_t i = 0; i < times.size(); i += pulses.looks) {
    if (i + pulses.looks > times.size() ||
        std::ranges::any_of(std::span(times).subspan(i, pulses.looks), [&](double t) { return t != times[i]; }))
      throw InputError(
          fmt::format("{}: the pulse at {:.9g} s has not as many looks as the first one, {}; compute every look of "
                      "every pulse",
                      what, times[i], pulses.looks));
    pulses.times.push_back(times[i]);
  }
  if (pulses.times.size() < 2) throw InputError(what + " has one pulse; velocities take several");
  return pulses;
}

void require_pulses(const SweepSamples& samples, const DopplerOptions& options, const std::string& what) {
  const PulseGrid pulses = pulse_grid(samples.times, what);
  even_times(pulses, what);
  looks_shown(pulses, options, what);
}

double DopplerMap::doppler_of(double v) const { return doppler(v, frequency); }
double Spectrogram::doppler_of(double v) const { return doppler(v, frequency); }

namespace {

// Places of antennas as the phase of a look has them: of transmitter and receiver together.
LookArray array_of(const SweepSamples& samples, const PulseGrid& pulses, const std::string& what) {
  std::vector<dvec3> places;
  for (std::size_t i = 0; i < pulses.looks; ++i) {
    const SweepLook& look = samples.looks[i];
    if (look.far()) throw InputError(what + ": an angle takes antennas at places, radar.position_m, not directions");
    places.push_back(look.transmit_range * look.transmit + look.receive_range * look.receive);
  }
  const std::optional<AngleGrid> grid = scan_grid(places);
  if (!grid || grid->theta_deg.count > 1)
    throw InputError(what + ": an angle takes the looks of a pulse from three places or more, in even steps on a straight line");
  return {pulses.looks, grid->phi_deg.step, grid->scan->fast};
}

DopplerMap map_over(const SweepSamples& samples, const PulseGrid& pulses, const LookArray& array, std::vector<std::size_t> looks,
                    const DopplerOptions& options, const std::string& what) {
  const std::size_t count = pulses.times.size();
  const auto padding = static_cast<std::size_t>(options.padding);
  DopplerMap map{samples.frequency.middle(), even_times(pulses, what), std::move(looks)};
  map.velocity_limits = velocity_limits(map.frequency, map.time, count, options.window);
  map.velocity = about(options.velocity, map.velocity_limits.cell / options.padding, padding * count);
  if (samples.frequency.count > 1) {
    map.range_limits = range_limits(samples.frequency, options.window);
    map.range = about(options.range, map.range_limits->cell / options.padding, padding * samples.frequency.count);
  }
  if (array.count > 1) {
    map.array = array.along;
    map.cosine_limits = axis_limits(wavelength(map.frequency) / array.step, array.count, options.window);
    const double step = map.cosine_limits->cell / options.padding;
    map.cosine = about(0.0, step, std::min(padding * array.count, 1 + 2 * static_cast<std::size_t>(1.0 / step)));
  }
  const std::size_t cells = map.range.count * map.velocity.count * map.cosine.count;
  require_cells(static_cast<double>(map.looks.size()) * static_cast<double>(cells), what);
  const PulseSamples pulse_samples(samples, pulses.looks, map.time, count, array, options.window);
  const GriddedTransform transform(
      {{map.range.count, map.velocity.count, map.cosine.count}, {map.range.step, map.velocity.step, map.cosine.step}},
      pulse_samples.wave_vectors());
  const dvec3 middle(map.range.at(map.range.count / 2), options.velocity, 0.0);
  map.s.resize(map.looks.size() * cells);
  tbb::parallel_for(std::size_t{0}, 4 * map.looks.size(), [&](std::size_t i) {
    const std::size_t look = i / 4;
    const auto channel = static_cast<int>(i % 4);
    const std::vector<Complex> values = pulse_samples.focused(transform, 0, map.looks[look], channel, middle);
    for (std::size_t at = 0; at < cells; ++at) map.s[look * cells + at].at(channel / 2, channel % 2) = values[at];
  });
  map.peak = peak_of(pulse_samples, map, options.padding);
  return map;
}

}  // namespace

DopplerMap doppler_map(const SweepSamples& samples, const DopplerOptions& options, const std::string& what) {
  const PulseGrid pulses = pulse_grid(samples.times, what);
  return map_over(samples, pulses, {}, looks_shown(pulses, options, what), options, what);
}

DopplerMap range_doppler_angle(const SweepSamples& samples, const DopplerOptions& options, const std::string& what) {
  const PulseGrid pulses = pulse_grid(samples.times, what);
  return map_over(samples, pulses, array_of(samples, pulses, what), {0}, options, what);
}

Spectrogram spectrogram(const SweepSamples& samples, const SpectrogramOptions& options, const std::string& what) {
  const PulseGrid pulses = pulse_grid(samples.times, what);
  const EvenAxis time = even_times(pulses, what);
  if (options.gate && samples.frequency.count < 2)
    throw InputError(what + ": a gate chooses ranges, which one frequency does not tell apart; compute several, or leave it out");
  const std::size_t count = pulses.times.size(),
                    length = options.length > 0 ? options.length : static_cast<std::size_t>(std::ceil(std::sqrt(count)));
  if (length < 2 || length > count)
    throw InputError(fmt::format("{}: a window of {} pulses; give it from 2 to {}, which is all of them", what, length, count));
  const auto hop =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround((1.0 - options.overlap) * static_cast<double>(length))));
  Spectrogram result{samples.frequency.middle(),
                     {time.at(0) + 0.5 * time.step * static_cast<double>(length - 1), time.step * static_cast<double>(hop),
                      1 + (count - length) / hop},
                     looks_shown(pulses, options, what),
                     length};
  result.velocity_limits = velocity_limits(result.frequency, time, length, options.window);
  result.velocity =
      about(options.velocity, result.velocity_limits.cell / options.padding, static_cast<std::size_t>(options.padding) * length);
  require_cells(static_cast<double>(result.looks.size()) * static_cast<double>(result.time.count) *
                    static_cast<double>(result.velocity.count),
                what);
  const EvenAxis range = gated(samples, options);
  const PulseSamples window(samples, pulses.looks, time, length, {}, options.window);
  const GriddedTransform transform({{range.count, result.velocity.count, 1}, {range.step, result.velocity.step, 1.0}},
                                   window.wave_vectors());
  const dvec3 middle(range.at(range.count / 2), options.velocity, 0.0);
  const double power = power_of_point(samples, window.of_frequency(), range);
  result.sigma.resize(result.looks.size() * result.time.count * result.velocity.count);
  tbb::parallel_for(std::size_t{0}, 4 * result.looks.size() * result.time.count, [&](std::size_t i) {
    const std::size_t look = i / 4 / result.time.count, at = i / 4 % result.time.count;
    const auto channel = static_cast<int>(i % 4);
    const std::vector<Complex> values = window.focused(transform, at * hop, result.looks[look], channel, middle);
    for (std::size_t r = 0; r < range.count; ++r)
      for (std::size_t v = 0; v < result.velocity.count; ++v)
        result.sigma[i / 4 * result.velocity.count + v][channel / 2][channel % 2] +=
            4.0 * pi * std::norm(values[r * result.velocity.count + v]) / power;
  });
  return result;
}

}  // namespace raytube
