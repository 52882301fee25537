#include "output/tables/cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>

#include "core/decimal.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

using Quantity = RowCoordinates::Quantity;
using Values = std::array<double, RowCoordinates::quantities>;

constexpr std::array<const char*, RowCoordinates::quantities> axis_labels = {"azimuth φ (degrees)",
                                                                             "polar angle θ (degrees)",
                                                                             "receiver azimuth φ (degrees)",
                                                                             "receiver polar angle θ (degrees)",
                                                                             "time (s)",
                                                                             "frequency (GHz)",
                                                                             "look number"};

// Rows grouped by everything but the axis, the groups in the order of their first row.
std::vector<std::vector<std::size_t>> groups_along(Quantity axis, const std::vector<Values>& rows) {
  std::map<Values, std::size_t> index_of;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Values key = rows[row];
    key[axis] = key[RowCoordinates::look_number] = 0.0;
    if (axis == RowCoordinates::look_number) {
      key = Values{};
      key[RowCoordinates::frequency] = rows[row][RowCoordinates::frequency];
    }
    const auto [entry, added] = index_of.try_emplace(key, groups.size());
    if (added) groups.emplace_back();
    groups[entry->second].push_back(row);
  }
  return groups;
}

std::string fixed_values(Quantity axis, const Values& row, const std::array<bool, RowCoordinates::quantities>& told) {
  std::string text;
  const auto add = [&](Quantity quantity, const char* name, const char* unit) {
    if (axis != quantity && told[quantity])
      text += fmt::format("{}{}{:.8g}{}", text.empty() ? "" : ", ", name, row[quantity], unit);
  };
  add(RowCoordinates::frequency, "", " GHz");
  if (axis == RowCoordinates::look_number) return text;
  add(RowCoordinates::theta, "θ = ", "°");
  add(RowCoordinates::phi, "φ = ", "°");
  add(RowCoordinates::rx_theta, "receiver θ = ", "°");
  add(RowCoordinates::rx_phi, "receiver φ = ", "°");
  add(RowCoordinates::time, "t = ", " s");
  return text;
}

void sort_along(Quantity axis, const RowCoordinates& coordinates, std::vector<std::size_t>& group) {
  std::stable_sort(group.begin(), group.end(),
                   [&](std::size_t a, std::size_t b) { return coordinates.rows[a][axis] < coordinates.rows[b][axis]; });
}

CutRows cut_rows(std::vector<std::size_t> group, Quantity axis, const RowCoordinates& coordinates) {
  sort_along(axis, coordinates, group);
  CutRows cut{fixed_values(axis, coordinates.rows[group.front()], coordinates.told), std::move(group), {}};
  for (const std::size_t row : cut.rows) cut.x.push_back(coordinates.rows[row][axis]);
  return cut;
}

bool holds(const std::vector<std::size_t>& rows, std::size_t row) { return std::ranges::find(rows, row) != rows.end(); }

constexpr double rounding = 1e-9;  // [degrees, GHz]: far above what computing an angle leaves, far below any step

void merge_equal_values(Quantity quantity, std::vector<Values>& rows) {
  std::vector<double> all, kept;
  for (const Values& row : rows) all.push_back(row[quantity]);
  std::ranges::sort(all);
  for (const double value : all)
    if (kept.empty() || value - kept.back() > rounding) kept.push_back(value);
  for (Values& row : rows) row[quantity] = *std::prev(std::ranges::upper_bound(kept, row[quantity]));
}

// A receiver that stands at the transmitter in every look tells nothing.
bool receiver_elsewhere(const Sweep& sweep) {
  return sweep.bistatic && std::ranges::any_of(sweep.looks, [](const Look& look) {
           return look.transmit.theta != look.receive.theta || look.transmit.phi != look.receive.phi;
         });
}

}  // namespace

void merge_equal_values(RowCoordinates& coordinates) {
  for (const Quantity quantity :
       {RowCoordinates::phi, RowCoordinates::theta, RowCoordinates::rx_phi, RowCoordinates::rx_theta, RowCoordinates::frequency})
    merge_equal_values(quantity, coordinates.rows);
}

RowCoordinates coordinates_of_rows(const Sweep& sweep) {
  const bool bistatic = receiver_elsewhere(sweep);
  RowCoordinates coordinates{{}, {true, true, bistatic, bistatic, !sweep.times.empty(), true, false}};
  coordinates.rows.reserve(sweep.rows());
  for (std::size_t i = 0; i < sweep.looks.size(); ++i) {
    const Direction &transmit = sweep.looks[i].transmit, &receive = sweep.looks[i].receive;
    Values row{decimal_degrees(transmit.phi), decimal_degrees(transmit.theta)};
    if (bistatic)
      row[RowCoordinates::rx_phi] = decimal_degrees(receive.phi), row[RowCoordinates::rx_theta] = decimal_degrees(receive.theta);
    if (!sweep.times.empty()) row[RowCoordinates::time] = sweep.times[i];
    row[RowCoordinates::look_number] = static_cast<double>(i);
    for (const double hertz : sweep.frequencies) {
      row[RowCoordinates::frequency] = hertz / 1e9;
      coordinates.rows.push_back(row);
    }
  }
  merge_equal_values(coordinates);
  return coordinates;
}

std::vector<std::vector<std::size_t>> rows_along(Quantity quantity, const RowCoordinates& coordinates) {
  std::vector<std::vector<std::size_t>> groups = groups_along(quantity, coordinates.rows);
  for (std::vector<std::size_t>& group : groups) sort_along(quantity, coordinates, group);
  return groups;
}

std::string axis_label(Quantity quantity) { return axis_labels[quantity]; }

CutPlan plan_cuts(const RowCoordinates& coordinates) {
  const std::vector<Values>& rows = coordinates.rows;
  Quantity axis = RowCoordinates::phi;
  auto groups = groups_along(axis, rows);
  for (const Quantity other :
       {RowCoordinates::theta, RowCoordinates::rx_phi, RowCoordinates::rx_theta, RowCoordinates::time, RowCoordinates::frequency})
    if (auto grouped = groups_along(other, rows); grouped.size() < groups.size()) axis = other, groups = std::move(grouped);
  if (rows.size() > 1 && 2 * groups.size() > rows.size()) groups = groups_along(axis = RowCoordinates::look_number, rows);
  CutPlan plan{axis, axis_label(axis), {}};
  for (auto& group : groups) plan.cuts.push_back(cut_rows(std::move(group), axis, coordinates));
  return plan;
}

std::string coordinates_text(const RowCoordinates& coordinates, std::size_t row) {
  return fixed_values(RowCoordinates::quantities, coordinates.rows[row], coordinates.told);
}

std::vector<std::size_t> spread_choice(std::size_t count, std::size_t most) {
  const std::size_t chosen = std::min(most, count);
  std::vector<std::size_t> choice;
  for (std::size_t i = 0; i < chosen; ++i) choice.push_back(chosen == 1 ? 0 : i * (count - 1) / (chosen - 1));
  return choice;
}

std::size_t peak_row(const SweepResult& result) {
  return static_cast<std::size_t>(std::ranges::max_element(result.total, {}, largest_amplitude) - result.total.begin());
}

namespace {

// Some of these cuts, evenly spread; the nearest to that through this row is replaced by it.
std::vector<std::size_t> choice_with(const std::vector<CutRows>& cuts, std::size_t row, std::size_t most) {
  std::vector<std::size_t> choice = spread_choice(cuts.size(), most);
  const auto through = std::ranges::find_if(cuts, [&](const CutRows& cut) { return holds(cut.rows, row); }) - cuts.begin();
  const auto nearest =
      std::ranges::min_element(choice, {}, [&](std::size_t i) { return std::abs(static_cast<std::ptrdiff_t>(i) - through); });
  if (nearest != choice.end() && through < std::ssize(cuts)) *nearest = static_cast<std::size_t>(through);
  return choice;
}

// The curves of S in these rows.
Cut curves_of(const CutRows& rows, Quantity quantity, const std::vector<ScatteringMatrix>& s) {
  Cut cut{rows.fixed, rows.x, {}, rows.rows, quantity};
  for (const std::size_t row : rows.rows)
    for (int channel = 0; channel < 4; ++channel)
      cut.sigma_dbsm[channel].push_back(sigma_dbsm(s[row].at(channel / 2, channel % 2)));
  return cut;
}

}  // namespace

Cuts choose_cuts(const Sweep& sweep, const SweepResult& result, std::size_t most_cuts) {
  const CutPlan plan = plan_cuts(coordinates_of_rows(sweep));
  Cuts chosen{plan.axis, {}, plan.cuts.size()};
  for (const std::size_t i : choice_with(plan.cuts, peak_row(result), most_cuts))
    chosen.cuts.push_back(curves_of(plan.cuts[i], plan.quantity, result.total));
  return chosen;
}

}  // namespace raytube
