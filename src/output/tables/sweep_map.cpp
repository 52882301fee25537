#include "output/tables/sweep_map.h"

#include <algorithm>
#include <tuple>

namespace raytube {

namespace {

using Quantity = RowCoordinates::Quantity;

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
  std::ranges::stable_sort(slice, {},
                           [&](std::size_t i) { return std::tuple(coordinates.rows[i][up], coordinates.rows[i][across]); });
  return slice;
}

std::vector<double> distinct_values(Quantity quantity, const std::vector<std::size_t>& rows, const RowCoordinates& coordinates) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(coordinates.rows[row][quantity]);
  std::ranges::sort(values);
  values.erase(std::ranges::unique(values).begin(), values.end());
  return values;
}

bool is_grid(const SweepMap& map, const RowCoordinates& coordinates) {
  if (map.rows.size() != map.x.size() * map.y.size()) return false;
  for (std::size_t i = 0; i < map.rows.size(); ++i) {
    const auto& row = coordinates.rows[map.rows[i]];
    if (row[map.across] != map.x[i % map.x.size()] || row[map.up] != map.y[i / map.x.size()]) return false;
  }
  return true;
}

}  // namespace

std::optional<SweepMap> map_through(std::size_t row, const RowCoordinates& coordinates, const CutPlan& plan,
                                    std::size_t most_cuts) {
  const Quantity across = plan.quantity;
  if (across == RowCoordinates::look_number || plan.cuts.size() <= most_cuts) return {};
  const Quantity up = longest_beside(across, row, coordinates);
  if (up == RowCoordinates::look_number) return {};
  SweepMap map{across, up, {}, {}, slice_through(row, across, up, coordinates), {}};
  map.x = distinct_values(across, map.rows, coordinates);
  map.y = distinct_values(up, map.rows, coordinates);
  RowCoordinates others{{coordinates.rows[row]}, coordinates.told};
  others.told[across] = others.told[up] = false;
  map.fixed = coordinates_text(others, 0);
  if (map.y.size() <= most_cuts || !is_grid(map, coordinates)) return {};
  return map;
}

}  // namespace raytube
