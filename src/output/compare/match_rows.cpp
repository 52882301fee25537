#include "output/compare/match_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/decimal.h"
#include "core/error.h"

namespace raytube {

namespace {

using Key = ResultTable::Key;
using Values = std::vector<double>;

// A key as a number in which equal steps count alike: the logarithm of a frequency, an azimuth without full turns.
double coordinate(Key key, double value) {
  if (key == ResultTable::frequency) return std::log(value);
  if (!is_azimuth(key)) return value;
  const double turned = std::remainder(value, 360.0);
  return turned <= -180.0 + angle_tolerance_deg ? turned + 360.0 : turned;
}

Values coordinates(const ResultTable& table, Key key) {
  Values values;
  for (const ResultTable::Row& row : table.rows) values.push_back(coordinate(key, row.key[key]));
  return values;
}

// Values closer than a hundred-thousandth of the tolerance are the same one, printed differently.
double smallest_step(Values values, double tolerance) {
  std::ranges::sort(values);
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double here = values[i] - values[i - 1]; here > 1e-5 * tolerance) step = std::min(step, here);
  return step;
}

// Equal values of both tables get equal numbers; `ids` begins with the rows of a, those of b follow.
std::vector<std::size_t> ids_of(const Values& a, const Values& b, double tolerance) {
  tolerance = std::min({tolerance, smallest_step(a, tolerance) / 3.0, smallest_step(b, tolerance) / 3.0});
  Values all = a;
  all.insert(all.end(), b.begin(), b.end());
  std::vector<std::size_t> order(all.size()), ids(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return all[i]; });
  std::size_t id = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && all[order[i]] - all[order[i - 1]] > tolerance) ++id;
    ids[order[i]] = id;
  }
  return ids;
}

std::string range_text(const ResultTable& table, Key key) {
  const auto [low, high] = std::ranges::minmax(table.rows, {}, [&](const ResultTable::Row& row) { return row.key[key]; });
  const std::string first = number_text(low.key[key]), last = number_text(high.key[key]);
  return first == last ? first : first + " to " + last;
}

void check_single_value(const ResultTable& table, const ResultTable& other, Key key) {
  const Values values = coordinates(table, key);
  const double tolerance = tolerance_of(key);
  const auto [low, high] = std::ranges::minmax(values);
  if (high - low > tolerance)
    throw InputError(fmt::format("{}: {} runs from {} but {} has no such column; choose one value with --only {}=VALUE",
                                 table.file.string(), key_names[key], range_text(table, key), other.file.string(),
                                 key_names[key]));
}

[[noreturn]] void reject_strangers(const ResultTable& a, const ResultTable& b, const std::array<bool, ResultTable::keys>& by) {
  std::string ranges;
  for (int k = 0; k < ResultTable::keys; ++k)
    if (const Key key = static_cast<Key>(k); by[k])
      ranges +=
          fmt::format("{}{} {} against {}", ranges.empty() ? "" : ", ", key_names[k], range_text(a, key), range_text(b, key));
  throw InputError(fmt::format("{} and {} have no row in common ({}); correct the columns or compare results of the same sweep",
                               a.file.string(), b.file.string(), ranges));
}

// All rows, those of a first, each as the numbers of its keys.
using RowIds = std::vector<std::array<std::size_t, ResultTable::keys>>;

RowIds row_ids(const ResultTable& a, const ResultTable& b, const std::array<bool, ResultTable::keys>& by) {
  RowIds rows(a.rows.size() + b.rows.size());
  for (int k = 0; k < ResultTable::keys; ++k) {
    if (!by[k]) continue;
    const Key key = static_cast<Key>(k);
    const double tolerance = tolerance_of(key);
    const std::vector<std::size_t> ids = ids_of(coordinates(a, key), coordinates(b, key), tolerance);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i][k] = ids[i];
  }
  return rows;
}

std::vector<std::size_t> sorted_rows(const RowIds& ids, std::size_t begin, std::size_t end) {
  std::vector<std::size_t> order(end - begin);
  std::iota(order.begin(), order.end(), begin);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return ids[i]; });
  return order;
}

std::array<bool, ResultTable::keys> common_keys(const ResultTable& a, const ResultTable& b) {
  std::array<bool, ResultTable::keys> by{};
  for (int k = 0; k < ResultTable::keys; ++k) {
    by[k] = a.has_key[k] && b.has_key[k];
    if (a.has_key[k] && !b.has_key[k]) check_single_value(a, b, static_cast<Key>(k));
    if (b.has_key[k] && !a.has_key[k]) check_single_value(b, a, static_cast<Key>(k));
  }
  if (std::ranges::none_of(by, std::identity{}))
    throw InputError(fmt::format("{} and {} have no column in common to match rows by; give both the column of what was swept",
                                 a.file.string(), b.file.string()));
  return by;
}

// Both tables' rows in the order of their numbers, side by side.
std::vector<std::pair<std::size_t, std::size_t>> equal_rows(const RowIds& ids, std::size_t rows_a) {
  const std::vector<std::size_t> order_a = sorted_rows(ids, 0, rows_a), order_b = sorted_rows(ids, rows_a, ids.size());
  std::vector<std::pair<std::size_t, std::size_t>> equal;
  for (std::size_t i = 0, j = 0; i < order_a.size() && j < order_b.size();) {
    const auto &first = ids[order_a[i]], &second = ids[order_b[j]];
    if (first == second) equal.emplace_back(order_a[i], order_b[j] - rows_a);
    const bool next_a = first <= second, next_b = second <= first;
    i += next_a, j += next_b;
  }
  std::ranges::sort(equal);
  return equal;
}

}  // namespace

RowMatch match_rows(const ResultTable& a, const ResultTable& b) {
  const auto by = common_keys(a, b);
  RowMatch match{by, equal_rows(row_ids(a, b, by), a.rows.size())};
  if (match.common.empty()) reject_strangers(a, b, by);
  return match;
}

}  // namespace raytube
