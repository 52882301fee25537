// Which row of one table belongs to which row of another.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "output/tables/result_table.h"

namespace raytube {

inline constexpr double angle_tolerance_deg = 1e-4;
inline constexpr double frequency_tolerance = 1e-6;  // relative
inline constexpr double time_tolerance_s = 1e-9;     // in which nothing on the road moves by a micrometre

/// How far values of a key that count as one may be apart: frequencies by their ratio.
constexpr double tolerance_of(ResultTable::Key key) {
  if (key == ResultTable::frequency) return frequency_tolerance;
  return key == ResultTable::time ? time_tolerance_s : angle_tolerance_deg;
}

/// Rows of two tables that belong together.
struct RowMatch {
  std::array<bool, ResultTable::keys> by{};                 // keys that both tables have
  std::vector<std::pair<std::size_t, std::size_t>> common;  // row of the first table, row of the second; in the first one's order
};

/// Rows belong together when all keys that both tables have agree to the tolerances above, or to a third of the smallest step of
/// either table where that is smaller; azimuths 360 degrees apart agree. Of rows that are repeated, the first belongs to the
/// first and so on. A key that only one table has must hold one value. Throws InputError when no row has a partner.
RowMatch match_rows(const ResultTable& a, const ResultTable& b);

}  // namespace raytube
