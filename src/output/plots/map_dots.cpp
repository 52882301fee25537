#include "output/plots/map_dots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/tables/sampled_rows.h"

namespace raytube {

namespace {

constexpr std::size_t most_dots_across = 480, most_dots_up = 300;  // about the pixels of a map

std::size_t nearest_value(const std::vector<double>& x, double to) {
  return static_cast<std::size_t>(std::ranges::min_element(x, {}, [&](double v) { return std::abs(v - to); }) - x.begin());
}

// One dot a value where these are even and not too many; otherwise as many as a map has room for.
DotAxis dot_axis(const std::vector<double>& x, std::size_t most) {
  const std::size_t count = x.size() <= most && in_even_steps(x) ? x.size() : most;
  const double low = x[0] - 0.5 * (x[1] - x[0]), high = x.back() + 0.5 * (x.back() - x[x.size() - 2]);
  const double step = (high - low) / static_cast<double>(count);
  DotAxis axis{low + 0.5 * step, step, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double from = low + step * static_cast<double>(i);
    const auto begin = std::ranges::lower_bound(x, from) - x.begin(), end = std::ranges::lower_bound(x, from + step) - x.begin();
    if (begin < end)
      axis.values.emplace_back(begin, end);
    else
      axis.values.emplace_back(nearest_value(x, from + 0.5 * step), nearest_value(x, from + 0.5 * step) + 1);
  }
  return axis;
}

// The strongest of the rows that a dot stands for, so that no peak is lost; NaN where there are none.
double level_of_dot(const SweepMap& map, const std::vector<double>& levels, std::pair<std::size_t, std::size_t> across,
                    std::pair<std::size_t, std::size_t> up) {
  double level = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t j = up.first; j < up.second; ++j)
    for (std::size_t i = across.first; i < across.second; ++i) level = std::fmax(level, levels[j * map.x.size() + i]);
  return level;
}

}  // namespace

DotAxis dots_across(const SweepMap& map) { return dot_axis(map.x, most_dots_across); }
DotAxis dots_up(const SweepMap& map) { return dot_axis(map.y, most_dots_up); }

std::vector<double> map_dots(const SweepMap& map, const std::vector<double>& levels, const DotAxis& across, const DotAxis& up) {
  std::vector<double> dots;
  for (const auto& below : up.values)
    for (const auto& beside : across.values) dots.push_back(level_of_dot(map, levels, beside, below));
  return dots;
}

}  // namespace raytube
