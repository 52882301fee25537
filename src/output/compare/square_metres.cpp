#include "output/compare/square_metres.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::size_t least_rows = 3;  // two may agree by chance
constexpr double far_db = 3.0;         // tables of the same target are nearer than this, in whatever unit
constexpr double times_nearer = 10.0;  // no error of a method does that

struct Distances {
  double as_read = 0.0, as_square_metres = 0.0;  // rms [dB]
};

// Zero with fewer rows than tell; not a number with a level below 0, which no square metres are.
Distances distances(const std::vector<std::pair<double, double>>& levels) {
  double as_read = 0.0, as_square_metres = 0.0;
  std::size_t rows = 0;
  for (const auto& [level, other] : levels) {
    if (std::isinf(level) || std::isinf(other)) continue;
    as_read += (level - other) * (level - other);
    as_square_metres += std::pow(10.0 * std::log10(level) - other, 2.0);
    ++rows;
  }
  if (rows < least_rows) return {};
  return {std::sqrt(as_read / static_cast<double>(rows)), std::sqrt(as_square_metres / static_cast<double>(rows))};
}

void check(const ResultTable& table, const ResultTable& other, const std::vector<std::pair<double, double>>& levels, int channel,
           const char* option) {
  const auto [as_read, as_square_metres] = distances(levels);
  if (as_read > far_db && as_square_metres < as_read / times_nearer)
    throw InputError(
        fmt::format("{0}: sigma_{1}_dbsm holds square metres, it seems: read as dBsm it lies {2:.3g} dB from {3}, read as m^2 "
                    "{4:.2g} dB; write {5} sigma_{1}_m2=NAME with that column's name",
                    table.file.string(), channel_names[channel], as_read, other.file.string(), as_square_metres, option));
}

}  // namespace

void refuse_square_metres(const ResultTable& result, const ResultTable& reference, const RowMatch& match) {
  for (int channel = 0; channel < 4; ++channel) {
    if (!result.has_channel[channel] || !reference.has_channel[channel]) continue;
    std::vector<std::pair<double, double>> forth, back;
    for (const auto& [i, j] : match.common) {
      forth.emplace_back(result.rows[i].sigma_dbsm[channel], reference.rows[j].sigma_dbsm[channel]);
      back.emplace_back(forth.back().second, forth.back().first);
    }
    if (result.has_level[channel]) check(result, reference, forth, channel, "--result-columns");
    if (reference.has_level[channel]) check(reference, result, back, channel, "--reference-columns");
  }
}

}  // namespace raytube
