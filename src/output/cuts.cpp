#include "output/cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "decimal.h"
#include "output/csv.h"

namespace raytube {

namespace {

// What may vary in a sweep, in the order in which it is preferred as the axis of a plot.
enum Quantity { phi, theta, rx_phi, rx_theta, frequency, look_number, quantities };
using Values = std::array<double, quantities>;

constexpr std::array<const char*, quantities> axis_labels = {"azimuth φ (degrees)",
                                                             "polar angle θ (degrees)",
                                                             "receiver azimuth φ (degrees)",
                                                             "receiver polar angle θ (degrees)",
                                                             "frequency (GHz)",
                                                             "look number"};

std::vector<Values> values_of_rows(const Sweep& sweep) {
  std::vector<Values> rows;
  rows.reserve(sweep.rows());
  for (std::size_t i = 0; i < sweep.looks.size(); ++i) {
    const auto& [transmit, receive] = sweep.looks[i];
    Values row{decimal_degrees(transmit.phi), decimal_degrees(transmit.theta)};
    if (sweep.bistatic) row[rx_phi] = decimal_degrees(receive.phi), row[rx_theta] = decimal_degrees(receive.theta);
    row[look_number] = static_cast<double>(i);
    for (const double hertz : sweep.frequencies) {
      row[frequency] = hertz / 1e9;
      rows.push_back(row);
    }
  }
  return rows;
}

// Rows grouped by everything but the axis, the groups in the order of their first row.
std::vector<std::vector<std::size_t>> groups_along(Quantity axis, const std::vector<Values>& rows) {
  std::map<Values, std::size_t> index_of;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Values key = rows[row];
    key[axis] = key[look_number] = 0.0;
    if (axis == look_number) key = Values{0.0, 0.0, 0.0, 0.0, key[frequency], 0.0};
    const auto [entry, added] = index_of.try_emplace(key, groups.size());
    if (added) groups.emplace_back();
    groups[entry->second].push_back(row);
  }
  return groups;
}

std::string fixed_values(Quantity axis, const Values& row, bool bistatic) {
  std::string text;
  const auto add = [&](Quantity quantity, const char* name, const char* unit) {
    if (axis != quantity) text += fmt::format("{}{}{:.8g}{}", text.empty() ? "" : ", ", name, row[quantity], unit);
  };
  add(frequency, "", " GHz");
  if (axis == look_number) return text;
  add(theta, "θ = ", "°");
  add(phi, "φ = ", "°");
  if (!bistatic) return text;
  add(rx_theta, "receiver θ = ", "°");
  add(rx_phi, "receiver φ = ", "°");
  return text;
}

Cut cut_of(std::vector<std::size_t> group, Quantity axis, const std::vector<Values>& rows, const SweepResult& result,
           bool bistatic) {
  std::stable_sort(group.begin(), group.end(), [&](std::size_t a, std::size_t b) { return rows[a][axis] < rows[b][axis]; });
  Cut cut{fixed_values(axis, rows[group.front()], bistatic), {}, {}};
  for (const std::size_t row : group) {
    const ScatteringMatrix& s = result.total[row];
    cut.x.push_back(rows[row][axis]);
    for (int channel = 0; channel < 4; ++channel) cut.sigma_dbsm[channel].push_back(sigma_dbsm(s.at(channel / 2, channel % 2)));
  }
  return cut;
}

}  // namespace

Cuts choose_cuts(const Sweep& sweep, const SweepResult& result, std::size_t most_cuts) {
  const std::vector<Values> rows = values_of_rows(sweep);
  Quantity axis = phi;
  auto groups = groups_along(phi, rows);
  for (const Quantity other : {theta, rx_phi, rx_theta, frequency})
    if (auto grouped = groups_along(other, rows); grouped.size() < groups.size()) axis = other, groups = std::move(grouped);
  if (rows.size() > 1 && 2 * groups.size() > rows.size()) groups = groups_along(axis = look_number, rows);

  Cuts chosen{axis_labels[axis], {}, groups.size()};
  const std::size_t shown = std::min(most_cuts, groups.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t at = shown == 1 ? 0 : i * (groups.size() - 1) / (shown - 1);
    chosen.cuts.push_back(cut_of(groups[at], axis, rows, result, sweep.bistatic));
  }
  return chosen;
}

}  // namespace raytube
