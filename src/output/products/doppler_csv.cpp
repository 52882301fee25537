#include "output/products/doppler_csv.h"

#include <fmt/format.h>

#include <cmath>

#include "output/files/files.h"
#include "output/products/amplitude_columns.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr const char* velocity_columns = "velocity_m_per_s,doppler_hz";

std::string limits_text(const AxisLimits& limits, double frequency) {
  return fmt::format(
      "# velocity_m_per_s: towards the radar, of a bistatic look half the rate at which the path shortens; doppler_hz: 2 v / "
      "lambda at {:.9g} Hz.\n"
      "# A point of sigma reads sigma. Peaks are {:.6g} m/s wide 3 dB below their top; what is {:.6g} m/s faster appears at the "
      "same velocity.\n",
      frequency, limits.resolution, limits.unambiguous);
}

std::string head(const DopplerMap& map, const Window& window) {
  std::string text = fmt::format(
      "# Range-Doppler map: M(R, v) = sum of w S exp(j 2 k (R - v t)) / sum of w over pulses and frequencies, weights w: {}.\n"
      "# look: of a pulse. Ranges are those in the middle of {} pulses, at {:.9g} s; t is counted from there.\n",
      name_of(window), map.time.count, map.time.middle());
  text += limits_text(map.velocity_limits, map.frequency);
  if (map.range_limits)
    text += fmt::format("# range_m: as in profile.csv; peaks are {:.6g} m wide, unambiguous {:.6g} m.\n",
                        map.range_limits->resolution, map.range_limits->unambiguous);
  if (map.cosine_limits)
    text += fmt::format(
        "# cosine: between the direction from the array of {} looks and that along it, {}; peaks are {:.6g} wide, unambiguous "
        "{:.6g}.\n",
        static_cast<int>(std::lround(map.cosine_limits->unambiguous / map.cosine_limits->cell)), vector_text(map.array),
        map.cosine_limits->resolution, map.cosine_limits->unambiguous);
  return text + "look," + (map.range_limits ? "range_m," : "") + velocity_columns + (map.cosine_limits ? ",cosine" : "");
}

std::string decibels(double sigma) { return fmt::format(",{:.3f}", 10.0 * std::log10(sigma)); }

}  // namespace

void write_doppler_csv(const std::filesystem::path& file, const DopplerMap& map, const Window& window) {
  OutputFile out(file);
  out.write(head(map, window) + amplitude_columns() + '\n');
  for (std::size_t i = 0; i < map.s.size(); ++i) {
    const std::size_t line = i / map.cosine.count, row = line / map.velocity.count;
    const double velocity = map.velocity.at(line % map.velocity.count) + 0.0;
    std::string text = std::to_string(map.looks[row / map.range.count]);
    if (map.range_limits) text += fmt::format(",{:.9g}", map.range.at(row % map.range.count) + 0.0);
    text += fmt::format(",{:.9g},{:.9g}", velocity, map.doppler_of(velocity));
    if (map.cosine_limits) text += fmt::format(",{:.9g}", map.cosine.at(i % map.cosine.count) + 0.0);
    out.write(text + amplitudes_text(map.s[i], 9) + '\n');
  }
  out.commit();
}

void write_spectrogram_csv(const std::filesystem::path& file, const Spectrogram& spectrogram, const Window& window) {
  OutputFile out(file);
  std::string header = fmt::format(
      "# Spectrogram: power of M(R, v) = sum of w S exp(j 2 k (R - v t)) / sum of w over the ranges of the gate, of {} pulses "
      "at a time,\n# weights w: {}. look: of a pulse; time_s: the middle of these pulses.\n",
      spectrogram.length, name_of(window));
  header += limits_text(spectrogram.velocity_limits, spectrogram.frequency) + "look,time_s," + velocity_columns;
  for (const char* channel : channel_names) header += fmt::format(",sigma_{}_dbsm", channel);
  out.write(header + '\n');
  for (std::size_t i = 0; i < spectrogram.sigma.size(); ++i) {
    const std::size_t row = i / spectrogram.velocity.count;
    const double velocity = spectrogram.velocity.at(i % spectrogram.velocity.count) + 0.0;
    std::string line = fmt::format("{},{:.9g},{:.9g},{:.9g}", spectrogram.looks[row / spectrogram.time.count],
                                   spectrogram.time.at(row % spectrogram.time.count), velocity, spectrogram.doppler_of(velocity));
    for (const auto& receive : spectrogram.sigma[i])
      for (const double sigma : receive) line += decibels(sigma);
    out.write(line + '\n');
  }
  out.commit();
}

}  // namespace raytube
