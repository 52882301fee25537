#include "output/plots/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr double shown_range_db = 80.0;  // deeper than any measurement; below it lie nulls and rounding dust

double highest(std::span<const Cut> cuts) {
  double peak = -std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts)
    for (const auto& channel : cut.sigma_dbsm)
      for (const double value : channel) peak = std::max(peak, value);
  return peak;
}

double lowest_shown(std::span<const Cut> cuts, double floor) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts)
    for (const auto& channel : cut.sigma_dbsm)
      for (const double value : channel)
        if (value >= floor) lowest = std::min(lowest, value);
  return lowest;
}

}  // namespace

Scale scale_of(std::span<const Cut> cuts) {
  const double peak = highest(cuts);
  if (!std::isfinite(peak)) return {-100.0, 0.0, -100.0};  // nothing comes back at all
  const double floor = peak - shown_range_db;
  return {10.0 * std::floor(lowest_shown(cuts, floor) / 10.0), 5.0 * std::ceil((peak + 2.0) / 5.0), floor};
}

std::string shown_level(double sigma_dbsm, const Scale& scale) {
  return fmt::format("{:.4f}", std::max(sigma_dbsm, scale.bottom - 20.0));
}

const char* curve_style(std::size_t points, bool joined) {
  if (points == 1 || !joined) return "points";
  return points <= 60 ? "linespoints" : "lines";
}

std::string xrange_of(const Cut& cut) {
  const double margin = cut.x.front() < cut.x.back() ? 0.0 : 1.0;
  return fmt::format("set xrange [{}:{}]\n", cut.x.front() - margin, cut.x.back() + margin);
}

}  // namespace raytube
