#include "output/statistics/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr double shown_below_peak = 60.0;
constexpr double beneath_all = -std::numeric_limits<double>::infinity();

// 2 (interquartile range) / cube root of the count.
double bin_width(const std::vector<double>& ascending) {
  const std::size_t n = ascending.size();
  const double quartiles = ascending[3 * (n - 1) / 4] - ascending[(n - 1) / 4];
  const double wanted = 2.0 * quartiles / std::cbrt(static_cast<double>(n));
  for (const double width : {0.5, 1.0, 2.0})
    if (wanted <= 1.5 * width) return width;
  return 5.0;
}

}  // namespace

Histogram histogram_of(std::span<const double> dbsm) {
  std::vector<double> levels(dbsm.begin(), dbsm.end());
  std::ranges::sort(levels);
  if (levels.empty() || !std::isfinite(levels.back())) return {};
  Histogram histogram{bin_width(levels), levels.size(), {}};
  const double width = histogram.width_db, floor = levels.back() - shown_below_peak;
  const double lowest = *std::ranges::lower_bound(levels, floor);
  const auto first = std::floor(lowest / width), last = std::floor(levels.back() / width);
  for (double i = first; i <= last; ++i) {
    const auto below = [&](double level) { return std::ranges::lower_bound(levels, level) - levels.begin(); };
    const double from = i == first && levels.front() < width * first ? beneath_all : width * i;
    histogram.bins.push_back({from, width * (i + 1.0), static_cast<std::size_t>(below(width * (i + 1.0)) - below(from))});
  }
  return histogram;
}

double expected_share(const LawFit& law, const HistogramBin& bin) {
  return law.below(bin.to_dbsm) - (std::isfinite(bin.from_dbsm) ? law.below(bin.from_dbsm) : 0.0);
}

}  // namespace raytube
