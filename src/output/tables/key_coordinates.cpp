#include "output/tables/key_coordinates.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace raytube {

namespace {

using Key = ResultTable;
using HasKey = std::array<bool, ResultTable::keys>;

bool receiver_elsewhere(std::span<const ResultTable::Keys> rows, const HasKey& has_key) {
  return std::ranges::any_of(rows, [&](const ResultTable::Keys& key) {
    return (has_key[Key::rx_theta] && (!has_key[Key::theta] || key[Key::rx_theta] != key[Key::theta])) ||
           (has_key[Key::rx_phi] &&
            (!has_key[Key::phi] || std::abs(std::remainder(key[Key::rx_phi] - key[Key::phi], 360.0)) > 1e-9));
  });
}

}  // namespace

RowCoordinates coordinates_of_keys(std::span<const ResultTable::Keys> rows, const HasKey& has_key) {
  const bool bistatic = receiver_elsewhere(rows, has_key);
  RowCoordinates coordinates{{},
                             {has_key[Key::phi], has_key[Key::theta], bistatic && has_key[Key::rx_phi],
                              bistatic && has_key[Key::rx_theta], has_key[Key::time], has_key[Key::frequency], false}};
  std::map<std::array<double, 5>, std::size_t> looks;
  for (const ResultTable::Keys& key : rows) {
    const double rx_phi = bistatic ? key[Key::rx_phi] : 0.0, rx_theta = bistatic ? key[Key::rx_theta] : 0.0;
    const std::array<double, 5> look = {key[Key::phi], key[Key::theta], rx_phi, rx_theta, key[Key::time]};
    const auto number = static_cast<double>(looks.try_emplace(look, looks.size()).first->second);
    coordinates.rows.push_back({look[0], look[1], look[2], look[3], look[4], key[Key::frequency] / 1e9, number});
  }
  merge_equal_values(coordinates);
  return coordinates;
}

}  // namespace raytube
