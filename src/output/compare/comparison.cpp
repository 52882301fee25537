#include "output/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "output/compare/curve_lag.h"
#include "output/compare/square_metres.h"
#include "output/tables/csv.h"
#include "output/tables/key_coordinates.h"

namespace raytube {

namespace {

// The keys of the result, and those that only the reference has.
void fill_keys(Comparison& c) {
  for (int k = 0; k < ResultTable::keys; ++k) c.has_key[k] = c.result.has_key[k] || c.reference.has_key[k];
  for (const auto& [i, j] : c.match.common) {
    ResultTable::Keys key = c.result.rows[i].key;
    for (int k = 0; k < ResultTable::keys; ++k)
      if (!c.result.has_key[k]) key[k] = c.reference.rows[j].key[k];
    c.keys.push_back(key);
  }
}

ChannelPair pair_of(const Comparison& c, int channel) {
  ChannelPair pair;
  const bool phase = c.result.has_phase[channel] && c.reference.has_phase[channel];
  for (const auto& [i, j] : c.match.common) {
    pair.result_dbsm.push_back(c.result.rows[i].sigma_dbsm[channel]);
    pair.reference_dbsm.push_back(c.reference.rows[j].sigma_dbsm[channel]);
    if (!phase) continue;
    pair.result.push_back(c.result.rows[i].s[channel]);
    pair.reference.push_back(c.reference.rows[j].s[channel]);
  }
  return pair;
}

void fill_pairs(Comparison& c) {
  for (int channel = 0; channel < 4; ++channel) {
    c.compared[channel] = c.result.has_channel[channel] && c.reference.has_channel[channel];
    if (!c.compared[channel]) continue;
    c.pairs[channel] = pair_of(c, channel);
    c.errors[channel].result_peak_dbsm = std::ranges::max(c.pairs[channel].result_dbsm);
    c.errors[channel].reference_peak_dbsm = std::ranges::max(c.pairs[channel].reference_dbsm);
  }
  if (std::ranges::none_of(c.compared, std::identity{}))
    throw InputError(
        fmt::format("{} and {} have no channel in common; give both re_vv and im_vv, or sigma_vv_dbsm, or another one",
                    c.result.file.string(), c.reference.file.string()));
}

void find_signals(Comparison& c) {
  double highest = sigma_dbsm(0.0);
  for (int channel = 0; channel < 4; ++channel)
    if (c.compared[channel]) highest = std::max(highest, c.errors[channel].reference_peak_dbsm);
  if (highest == sigma_dbsm(0.0))
    throw InputError(
        fmt::format("{}: zero in every row and channel compared; give a reference with a signal", c.reference.file.string()));
  for (int channel = 0; channel < 4; ++channel) {
    const ErrorMeasures& peaks = c.errors[channel];
    c.signal[channel] = c.compared[channel] && peaks.reference_peak_dbsm >= highest - dynamic_range_db;
    c.unexpected[channel] = c.compared[channel] && !c.signal[channel] && peaks.result_peak_dbsm >= highest - c.within_db;
  }
}

// Lists of looks in no order have no axis to be shifted along.
double lag_along_cuts(const Comparison& c, const ChannelPair& pair) {
  if (c.cuts.quantity == RowCoordinates::look_number) return ErrorMeasures::undefined;
  const double floor = std::ranges::max(pair.reference_dbsm) - dynamic_range_db;
  std::vector<CurvePair> curves;
  for (const CutRows& cut : c.cuts.cuts) {
    CurvePair& curve = curves.emplace_back(CurvePair{cut.x, {}, {}});
    for (const std::size_t row : cut.rows) {
      curve.a.push_back(std::max(pair.result_dbsm[row], floor));
      curve.b.push_back(std::max(pair.reference_dbsm[row], floor));
    }
  }
  return best_lag(curves);
}

}  // namespace

Comparison compare_results(ResultTable result, ResultTable reference, double within_db, bool free_scale) {
  Comparison c;
  c.result = std::move(result), c.reference = std::move(reference), c.within_db = within_db;
  c.match = match_rows(c.result, c.reference);
  refuse_square_metres(c.result, c.reference, c.match);
  if (free_scale) {
    c.scale = fit_scale(c.result, c.reference, c.match);
    apply_scale(c.result, c.scale->factor);
  }
  fill_keys(c);
  fill_pairs(c);
  find_signals(c);
  c.coordinates = coordinates_of_keys(c.keys, c.has_key);
  c.cuts = plan_cuts(c.coordinates);
  for (int channel = 0; channel < 4; ++channel) {
    c.lag[channel] = ErrorMeasures::undefined;
    if (!c.signal[channel]) continue;
    c.errors[channel] = measure_errors(c.pairs[channel], within_db);
    c.lag[channel] = lag_along_cuts(c, c.pairs[channel]);
  }
  return c;
}

double relative_error(const Comparison& c) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (c.result.rows.size() != c.rows() || c.reference.rows.size() != c.rows()) return none;
  double difference = 0.0, whole = 0.0, largest = 0.0;
  for (const ChannelPair& pair : c.pairs)
    for (const Complex s : pair.reference) largest = std::max(largest, std::abs(s));
  for (int channel = 0; channel < 4; ++channel) {
    if (c.result.has_channel[channel] != c.reference.has_channel[channel]) return none;
    if (!c.compared[channel]) continue;
    const ChannelPair& pair = c.pairs[channel];
    if (pair.reference.size() != c.rows()) return none;
    for (std::size_t row = 0; row < c.rows(); ++row) {
      difference += std::norm((pair.result[row] - pair.reference[row]) / largest);
      whole += std::norm(pair.reference[row] / largest);
    }
  }
  return whole > 0.0 ? std::sqrt(difference / whole) : none;
}

}  // namespace raytube
