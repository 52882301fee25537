// The dots of a map: as many as there are values, or as there is room for.
#pragma once

#include <utility>
#include <vector>

#include "output/tables/sweep_map.h"

namespace raytube {

/// Even dots along an axis, and the values [first, last) that each one stands for.
struct DotAxis {
  double first, step;  // middle of the first dot
  std::vector<std::pair<std::size_t, std::size_t>> values;

  double low() const { return first - 0.5 * step; }
  double high() const { return low() + step * static_cast<double>(values.size()); }
};

/// One dot a value where these are even and not too many; otherwise about as many as a map has pixels.
DotAxis dots_across(const SweepMap& map);
DotAxis dots_up(const SweepMap& map);

/// Lines of dots from below, of levels of which there is one for each place of the map: the strongest of those that a dot stands
/// for, so that no peak is lost; NaN where there are none.
std::vector<double> map_dots(const SweepMap& map, const std::vector<double>& levels, const DotAxis& across, const DotAxis& up);

}  // namespace raytube
