#include "output/compare/error_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace raytube {

namespace {

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double relative_error(std::span<const Complex> result, std::span<const Complex> reference) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    difference += std::norm(result[i] - reference[i]);
    size += std::norm(reference[i]);
  }
  return result.empty() ? ErrorMeasures::undefined : std::sqrt(difference / size);
}

std::vector<double> raised(std::span<const double> levels, double floor) {
  std::vector<double> values(levels.begin(), levels.end());
  for (double& value : values) value = std::max(value, floor);
  return values;
}

double mean_distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

// Of the rows whose reference is near its peak.
void measure_decibels(const ChannelPair& pair, double within_db, ErrorMeasures& errors) {
  std::vector<double> signed_db, absolute_db, squares;
  errors.largest_abs_db = -1.0;
  for (std::size_t i = 0; i < pair.reference_dbsm.size(); ++i) {
    if (pair.reference_dbsm[i] < errors.reference_peak_dbsm - within_db) continue;
    const double difference = pair.result_dbsm[i] - pair.reference_dbsm[i], size = std::abs(difference);
    signed_db.push_back(difference), absolute_db.push_back(size), squares.push_back(size * size);
    if (size > errors.largest_abs_db) errors.largest_abs_db = size, errors.largest_row = i;
  }
  errors.within = signed_db.size();
  errors.rms_db = std::sqrt(mean(squares));
  errors.mean_abs_db = mean(absolute_db);
  errors.median_abs_db = quantile(absolute_db, 0.5);
  errors.p95_abs_db = quantile(absolute_db, 0.95);
  errors.bias_db = mean(signed_db);
}

}  // namespace

double quantile(std::vector<double> values, double q) {
  const double position = q * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(position), above = std::min(below + 1, values.size() - 1);
  std::ranges::sort(values);
  const double t = position - static_cast<double>(below);
  return t == 0.0 || values[below] == values[above] ? values[below] : (1.0 - t) * values[below] + t * values[above];
}

double correlation(std::span<const double> a, std::span<const double> b) {
  const double mean_a = mean(a), mean_b = mean(b);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = a[i] - mean_a, db = b[i] - mean_b;
    aa += da * da, bb += db * db, ab += da * db;
  }
  const double least = 1e-18 * static_cast<double>(a.size());  // a deviation of a billionth of a decibel is rounding
  return aa <= least || bb <= least ? ErrorMeasures::undefined : ab / std::sqrt(aa * bb);
}

ErrorMeasures measure_errors(const ChannelPair& pair, double within_db) {
  ErrorMeasures errors;
  const auto peak = std::ranges::max_element(pair.reference_dbsm);
  errors.result_peak_dbsm = std::ranges::max(pair.result_dbsm);
  errors.reference_peak_dbsm = *peak;
  measure_decibels(pair, within_db, errors);
  errors.at_peak_db = pair.result_dbsm[peak - pair.reference_dbsm.begin()] - *peak;
  errors.relative_error = relative_error(pair.result, pair.reference);
  const double floor = *peak - dynamic_range_db;
  const std::vector<double> a = raised(pair.result_dbsm, floor), b = raised(pair.reference_dbsm, floor);
  errors.austin_db = mean_distance(a, b);
  errors.correlation = correlation(a, b);
  return errors;
}

}  // namespace raytube
