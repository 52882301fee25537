// Two results beside each other: common rows, channels, cuts and error measures.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "output/compare/error_measures.h"
#include "output/compare/free_scale.h"
#include "output/compare/match_rows.h"
#include "output/tables/cuts.h"
#include "output/tables/result_table.h"

namespace raytube {

struct Comparison {
  ResultTable result, reference;
  double within_db;
  RowMatch match;
  std::optional<FreeScale> scale;  // fitted, and in the result already

  // Of the common rows:
  std::array<bool, ResultTable::keys> has_key{};
  std::vector<ResultTable::Keys> keys;
  RowCoordinates coordinates;
  CutPlan cuts;

  // Of the channels:
  std::array<bool, 4> compared{};    // both tables have it
  std::array<bool, 4> signal{};      // and its reference comes within dynamic_range_db of the highest level of all channels
  std::array<bool, 4> unexpected{};  // it does not, but the result comes within within_db of that level
  std::array<ChannelPair, 4> pairs;
  std::array<ErrorMeasures, 4> errors;  // without signal: the peaks alone
  std::array<double, 4> lag;            // of the result against the reference, see best_lag; NaN for looks in no order

  std::size_t rows() const { return keys.size(); }
};

/// With `free_scale` the result is first multiplied by the factor that brings it nearest to the reference. Throws InputError if
/// the tables share no row or no channel, or if the reference is zero throughout.
Comparison compare_results(ResultTable result, ResultTable reference, double within_db, bool free_scale = false);

/// ||result - reference|| / ||reference|| of complex S over all common rows and channels; infinite if a table has rows or
/// channels of its own, or magnitudes only.
double relative_error(const Comparison& comparison);

}  // namespace raytube
