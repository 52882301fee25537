#include "output/tables/sweep_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raytube {

namespace {

using Quantity = RowCoordinates::Quantity;

constexpr std::size_t least_of_a_line = 3;  // rows, on average

std::size_t differing(const RowCoordinates& coordinates, std::size_t row, Quantity quantity) {
  for (const auto& group : rows_along(quantity, coordinates))
    if (std::ranges::find(group, row) != group.end()) return group.size();
  return 0;
}

// Along which the most rows lie beside this one.
Quantity longest_beside(Quantity axis, std::size_t row, const RowCoordinates& coordinates) {
  Quantity longest = RowCoordinates::look_number;
  std::size_t most = 1;
  for (const Quantity other :
       {RowCoordinates::phi, RowCoordinates::theta, RowCoordinates::rx_phi, RowCoordinates::rx_theta, RowCoordinates::frequency})
    if (other != axis && coordinates.told[other])
      if (const std::size_t rows = differing(coordinates, row, other); rows > most) longest = other, most = rows;
  return longest;
}

// Rows that differ from this one in the two quantities at most.
std::vector<std::size_t> slice_through(std::size_t row, Quantity across, Quantity up, const RowCoordinates& coordinates) {
  const auto key = [&](std::size_t i) {
    auto values = coordinates.rows[i];
    values[across] = values[up] = values[RowCoordinates::look_number] = 0.0;
    return values;
  };
  std::vector<std::size_t> slice;
  for (std::size_t i = 0; i < coordinates.rows.size(); ++i)
    if (key(i) == key(row)) slice.push_back(i);
  return slice;
}

std::vector<double> distinct_values(Quantity quantity, const std::vector<std::size_t>& rows, const RowCoordinates& coordinates) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(coordinates.rows[row][quantity]);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t place_of(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::ranges::lower_bound(values, value) - values.begin());
}

// Row i at its place of the grid.
std::vector<std::size_t> in_grid(const SweepMap& map, const RowCoordinates& coordinates) {
  std::vector<std::size_t> grid(map.x.size() * map.y.size(), SweepMap::hole);
  for (const std::size_t i : map.rows) {
    const auto& row = coordinates.rows[i];
    std::size_t& place = grid[place_of(map.y, row[map.up]) * map.x.size() + place_of(map.x, row[map.across])];
    place = std::min(place, i);
  }
  return grid;
}

using Line = std::vector<std::pair<double, std::size_t>>;  // rows of one value of the other quantity, along the axis

std::vector<Line> lines_of(const SweepMap& map, const RowCoordinates& coordinates) {
  std::vector<Line> lines(map.y.size());
  for (const std::size_t i : map.rows)
    lines[place_of(map.y, coordinates.rows[i][map.up])].emplace_back(coordinates.rows[i][map.across], i);
  for (Line& line : lines) std::ranges::sort(line);
  return lines;
}

// No farther away than a whole step of the line, which is closed by a turn where the axis is one.
std::size_t nearest_of(const Line& line, double x, bool turn) {
  const auto distance = [&](const auto& point) {
    return turn ? std::abs(std::remainder(point.first - x, 360.0)) : std::abs(point.first - x);
  };
  const auto nearest = std::ranges::min_element(line, {}, distance);
  const double step = (line.back().first - line.front().first) / static_cast<double>(std::max<std::size_t>(line.size() - 1, 1));
  return distance(*nearest) <= std::max(step, 1e-9) ? nearest->second : SweepMap::hole;
}

void fill_from_lines(SweepMap& map, const RowCoordinates& coordinates) {
  const std::vector<Line> lines = lines_of(map, coordinates);
  const Line& longest = *std::ranges::max_element(lines, {}, &Line::size);
  const bool turn = map.across == RowCoordinates::phi || map.across == RowCoordinates::rx_phi;
  map.x.clear();
  map.rows.clear();
  for (const auto& [x, row] : longest) map.x.push_back(x);
  for (const Line& line : lines)
    for (const double x : map.x) map.rows.push_back(line.size() > 1 ? nearest_of(line, x, turn) : line.front().second);
}

// Before there is memory for a grid, which of scattered looks is far larger than they are.
bool may_fill_half(const SweepMap& map) { return 2 * map.rows.size() >= map.x.size() * map.y.size(); }

bool fills_half(const SweepMap& map) {
  return 2 * std::ranges::count(map.rows, SweepMap::hole) <= static_cast<std::ptrdiff_t>(map.rows.size());
}

}  // namespace

std::optional<SweepMap> map_through(std::size_t row, const RowCoordinates& coordinates, const CutPlan& plan,
                                    std::size_t most_cuts) {
  const Quantity across = plan.quantity;
  if (across == RowCoordinates::look_number || plan.cuts.size() <= most_cuts) return {};
  const Quantity up = longest_beside(across, row, coordinates);
  if (up == RowCoordinates::look_number) return {};
  SweepMap map{across, up, {}, {}, slice_through(row, across, up, coordinates), {}};
  map.held = map.rows.size();
  map.x = distinct_values(across, map.rows, coordinates);
  map.y = distinct_values(up, map.rows, coordinates);
  RowCoordinates others{{coordinates.rows[row]}, coordinates.told};
  others.told[across] = others.told[up] = false;
  map.fixed = coordinates_text(others, 0);
  if (map.y.size() <= most_cuts) return {};
  if (may_fill_half(map)) {
    SweepMap grid = map;
    grid.rows = in_grid(map, coordinates);
    if (fills_half(grid)) return grid;
  }
  if (map.rows.size() < least_of_a_line * map.y.size()) return {};
  fill_from_lines(map, coordinates);
  return map;
}

}  // namespace raytube
