#include "output/statistics/sigma_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decimal.h"
#include "core/error.h"
#include "output/tables/sliding_sector.h"

namespace raytube {

namespace {

constexpr double slack = 1e-9;  // [degrees]: 0.1 + 0.2 is not 0.3

double percentile(const std::vector<double>& ascending, double percent) {
  const double rank = percent / 100.0 * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const double low = ascending[below], high = ascending[std::min(below + 1, ascending.size() - 1)];
  if (low == high || !std::isfinite(low)) return low;
  return low + (rank - static_cast<double>(below)) * (high - low);
}

double deviation_of(const std::vector<double>& levels) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const double level : levels)
    if (std::isfinite(level)) sum += level, ++count;
  for (const double level : levels)
    if (std::isfinite(level)) squares += (level - sum / count) * (level - sum / count);
  return count < 2.0 ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(squares / (count - 1.0));
}

bool over_angle(RowCoordinates::Quantity axis) {
  return axis != RowCoordinates::frequency && axis != RowCoordinates::look_number;
}

bool over_full_turn(const CutRows& cut, RowCoordinates::Quantity axis) {
  return (axis == RowCoordinates::phi || axis == RowCoordinates::rx_phi) && goes_round(cut.x);
}

// Rows along the axis; of a full turn three of them one after the other, with each direction once a turn.
struct Unrolled {
  std::vector<double> x;
  std::vector<std::size_t> rows;
};

Unrolled unrolled(const CutRows& cut, bool round) {
  if (!round) return {cut.x, cut.rows};
  const std::size_t turn = cut.x.size() - (cut.x.back() - cut.x.front() > 360.0 - slack ? 1 : 0);
  Unrolled line;
  for (const double shift : {-360.0, 0.0, 360.0})
    for (std::size_t i = 0; i < turn; ++i) line.x.push_back(cut.x[i] + shift), line.rows.push_back(cut.rows[i]);
  return line;
}

}  // namespace

double SigmaSummary::mean_dbsm() const { return 10.0 * std::log10(mean_m2); }

SigmaSummary sigma_summary(std::vector<double> dbsm, std::span<const double> percentiles) {
  std::ranges::sort(dbsm);
  SigmaSummary summary{dbsm.size(), 0.0, percentile(dbsm, 50.0), deviation_of(dbsm), {}};
  for (const double level : dbsm) summary.mean_m2 += std::pow(10.0, level / 10.0);
  summary.mean_m2 /= static_cast<double>(dbsm.size());
  for (const double percent : percentiles) summary.percentiles_dbsm.push_back(percentile(dbsm, percent));
  return summary;
}

std::vector<WindowRows> sliding_windows(const CutRows& cut, RowCoordinates::Quantity axis, double width) {
  const bool round = over_full_turn(cut, axis);
  const Unrolled line = unrolled(cut, round);
  std::vector<WindowRows> windows;
  for (const double middle : cut.x) {
    const double from = middle - 0.5 * width, to = middle + 0.5 * width;
    if (!round && (from < cut.x.front() - slack || to > cut.x.back() + slack)) continue;
    const auto first = std::ranges::lower_bound(line.x, from - slack) - line.x.begin();
    // Of a whole turn both ends are one direction.
    const auto last = std::ranges::upper_bound(line.x, width > 360.0 - slack ? to - 2.0 * slack : to + slack) - line.x.begin();
    windows.push_back({from, to, {line.rows.begin() + first, line.rows.begin() + last}});
  }
  return windows;
}

void require_windows(const ChartResult& result, double width) {
  if (!over_angle(result.plan.quantity))
    throw InputError(
        fmt::format("--window: {} is a sweep over {}, not over an angle; leave it out", result.file.string(), result.plan.axis));
  double widest = 0.0;
  for (const CutRows& cut : result.plan.cuts)
    widest = std::max(widest, over_full_turn(cut, result.plan.quantity) ? 360.0 : cut.x.back() - cut.x.front());
  if (width > widest + slack)
    throw InputError(fmt::format("--window {}: {} sweeps over {} degrees only; take a narrower one", number_text(width),
                                 result.file.string(), number_text(widest)));
}

std::vector<double> levels_of_rows(const ChartResult& result, std::size_t channel, std::span<const std::size_t> rows) {
  std::vector<double> levels;
  for (const std::size_t row : rows) levels.push_back(result.sigma_dbsm[channel][row]);
  return levels;
}

}  // namespace raytube
