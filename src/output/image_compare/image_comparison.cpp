#include "output/image_compare/image_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "output/image_compare/registration.h"
#include "output/image_compare/structural_similarity.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

using Amplitudes = std::vector<Complex>;

void find_channels(ImageComparison& c) {
  for (int channel = 0; channel < 4; ++channel)
    c.compared[channel] = c.result.has_channel[channel] && c.reference.has_channel[channel];
  if (std::ranges::none_of(c.compared, std::identity{}))
    throw InputError(
        fmt::format("{} and {} have no channel in common; name one in --result-columns or --reference-columns, as in "
                    "magnitude_vv=NAME",
                    c.result.file.string(), c.reference.file.string()));
}

bool has_phase(const ImageComparison& c, int channel) { return c.result.has_phase[channel] && c.reference.has_phase[channel]; }

std::vector<double> sizes(const Amplitudes& values) {
  std::vector<double> found(values.size());
  std::ranges::transform(values, found.begin(), [](Complex s) { return std::abs(s); });
  return found;
}

Amplitudes magnitudes(const Amplitudes& values) {
  const std::vector<double> found = sizes(values);
  return Amplitudes(found.begin(), found.end());
}

Amplitudes result_at(const ImageComparison& c, int channel, const PixelMap& map) {
  const Amplitudes& values = c.result.s[channel];
  return has_phase(c, channel) ? sampled(c.result, values, map) : magnitudes(sampled(c.result, magnitudes(values), map));
}

Amplitudes reference_at(const ImageComparison& c, int channel, const PixelMap& map) {
  const Amplitudes found = cropped(c.reference, c.reference.s[channel], map);
  return has_phase(c, channel) ? found : magnitudes(found);
}

void register_images(ImageComparison& c) {
  const PixelMap unshifted = c.map;
  std::vector<MagnitudePair> channels;
  for (int channel = 0; channel < 4; ++channel)
    if (c.compared[channel])
      channels.push_back({sizes(result_at(c, channel, unshifted)), sizes(reference_at(c, channel, unshifted))});
  c.shift = best_shift(channels, unshifted.across.count, unshifted.up.count);
  c.map = map_pixels(c.result, c.reference, c.shift);
}

std::vector<double> levels(const Amplitudes& values) {
  std::vector<double> found(values.size());
  std::ranges::transform(values, found.begin(), sigma_dbsm);
  return found;
}

// With the amplitudes, whether they have phase or not.
void fill_pairs(ImageComparison& c) {
  for (int channel = 0; channel < 4; ++channel)
    if (c.compared[channel]) c.pairs[channel] = {{}, {}, result_at(c, channel, c.map), reference_at(c, channel, c.map)};
}

void scale_result(ImageComparison& c) {
  ScaleFit fit;
  for (int channel = 0; channel < 4; ++channel) {
    if (!c.compared[channel]) continue;
    if (!has_phase(c, channel)) fit.leave_phase();
    for (std::size_t i = 0; i < c.pixels(); ++i) fit.add(c.pairs[channel].result[i], c.pairs[channel].reference[i]);
  }
  c.scale = fit.scale(c.result.file, c.reference.file);
  for (ChannelPair& pair : c.pairs)
    for (Complex& value : pair.result) value *= c.scale->factor;
}

void find_signals(ImageComparison& c) {
  double highest = sigma_dbsm(0.0);
  for (int channel = 0; channel < 4; ++channel) {
    if (!c.compared[channel]) continue;
    ChannelPair& pair = c.pairs[channel];
    pair.result_dbsm = levels(pair.result), pair.reference_dbsm = levels(pair.reference);
    c.measures[channel].errors.result_peak_dbsm = std::ranges::max(pair.result_dbsm);
    c.measures[channel].errors.reference_peak_dbsm = std::ranges::max(pair.reference_dbsm);
    highest = std::max(highest, c.measures[channel].errors.reference_peak_dbsm);
  }
  if (highest == sigma_dbsm(0.0))
    throw InputError(fmt::format("{}: zero in every pixel compared; give a reference with a signal", c.reference.file.string()));
  for (int channel = 0; channel < 4; ++channel) {
    const ErrorMeasures& peaks = c.measures[channel].errors;
    c.signal[channel] = c.compared[channel] && peaks.reference_peak_dbsm >= highest - dynamic_range_db;
    c.unexpected[channel] = c.compared[channel] && !c.signal[channel] && peaks.result_peak_dbsm >= highest - c.within_db;
  }
}

double squares(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

// Levels above a floor.
std::vector<double> above(std::span<const double> levels_db, double floor) {
  std::vector<double> found(levels_db.size());
  std::ranges::transform(levels_db, found.begin(), [floor](double level) { return std::max(level - floor, 0.0); });
  return found;
}

void measure_magnitudes(const ChannelPair& pair, ImageMeasures& measures) {
  const double peak = std::pow(10.0, measures.errors.reference_peak_dbsm / 20.0) / std::sqrt(4.0 * pi);
  std::vector<double> a = sizes(pair.result), b = sizes(pair.reference), difference;
  for (std::vector<double>* values : {&a, &b})
    for (double& value : *values) value /= peak;
  for (std::size_t i = 0; i < a.size(); ++i) difference.push_back(a[i] - b[i]);
  measures.correlation = correlation(a, b);
  measures.magnitude_error = std::sqrt(squares(difference) / squares(b));
  measures.power_ratio_db = 10.0 * std::log10(squares(a) / squares(b));
}

void measure(ImageComparison& c, int channel) {
  ChannelPair pair = c.pairs[channel];
  ImageMeasures& measures = c.measures[channel];
  const double peak = measures.errors.reference_peak_dbsm, result_peak = measures.errors.result_peak_dbsm;
  measure_magnitudes(pair, measures);
  for (double& level : pair.result_dbsm) level = std::max(level, peak - dynamic_range_db);
  if (!has_phase(c, channel)) pair.result.clear(), pair.reference.clear();
  measures.errors = measure_errors(pair, c.within_db);
  measures.errors.result_peak_dbsm = result_peak;
  if (c.within_db > 0.0)
    measures.similarity = structural_similarity(above(pair.result_dbsm, peak - c.within_db),
                                                above(pair.reference_dbsm, peak - c.within_db), c.map.across.count, c.within_db);
}

}  // namespace

ImageComparison compare_images(PixelImage result, PixelImage reference, const ImageComparisonOptions& options) {
  ImageComparison c{std::move(result), std::move(reference), options.within_db, options.registered};
  find_channels(c);
  c.map = map_pixels(c.result, c.reference);
  if (options.registered) register_images(c);
  fill_pairs(c);
  if (options.free_scale) scale_result(c);
  find_signals(c);
  for (int channel = 0; channel < 4; ++channel)
    if (c.signal[channel]) measure(c, channel);
  return c;
}

double relative_error(const ImageComparison& c) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (c.result.has_channel != c.reference.has_channel) return none;
  double largest = 0.0, difference = 0.0, whole = 0.0;
  for (const ChannelPair& pair : c.pairs)
    for (const Complex s : pair.reference) largest = std::max(largest, std::abs(s));
  for (int channel = 0; channel < 4; ++channel) {
    if (c.compared[channel] && !has_phase(c, channel)) return none;
    for (std::size_t i = 0; i < c.pairs[channel].reference.size(); ++i) {
      difference += std::norm((c.pairs[channel].result[i] - c.pairs[channel].reference[i]) / largest);
      whole += std::norm(c.pairs[channel].reference[i] / largest);
    }
  }
  return std::sqrt(difference / whole);
}

}  // namespace raytube
