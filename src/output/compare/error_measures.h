// How far a result is from a reference: error measures of one channel.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

/// More than this below the peak lie nulls and rounding dust: the floor of the Austin measure and of the correlation [dB].
inline constexpr double dynamic_range_db = 80.0;

/// One channel of a result and of its reference, row beside row.
struct ChannelPair {
  std::vector<double> result_dbsm, reference_dbsm;  // -inf for zero
  std::vector<Complex> result, reference;           // [m]; empty unless both have phase
};

/// Differences are result minus reference in dB; infinite where only one of them is zero. NaN where a measure does not exist.
struct ErrorMeasures {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  double result_peak_dbsm = undefined, reference_peak_dbsm = undefined;
  // Over the rows whose reference is near enough to its peak:
  std::size_t within = 0;  // their number
  double rms_db = undefined, mean_abs_db = undefined, median_abs_db = undefined, p95_abs_db = undefined, bias_db = undefined;
  double largest_abs_db = undefined;
  std::size_t largest_row = 0;
  double at_peak_db = undefined;  // at the reference's highest row
  // Over all rows:
  double relative_error = undefined;  // ||result - reference|| / ||reference||, complex
  double austin_db = undefined;       // mean distance of the levels, both raised to the floor
  double correlation = undefined;     // Pearson's, of the levels, both raised to the floor
};

/// One measure: its name in files, in words, and its value.
struct NamedMeasure {
  const char *name, *words;
  double ErrorMeasures::*value;
};

static_assert(dynamic_range_db == 80.0, "the words below name it");
inline constexpr std::array<NamedMeasure, 2> peak_measures{
    {{"result_peak_dbsm", "peak of the result, dBsm", &ErrorMeasures::result_peak_dbsm},
     {"reference_peak_dbsm", "peak of the reference, dBsm", &ErrorMeasures::reference_peak_dbsm}}};
inline constexpr std::array<NamedMeasure, 7> near_peak_measures{
    {{"rms_db", "rms", &ErrorMeasures::rms_db},
     {"mean_abs_db", "mean |error|", &ErrorMeasures::mean_abs_db},
     {"median_abs_db", "median |error|", &ErrorMeasures::median_abs_db},
     {"p95_abs_db", "95th percentile of |error|", &ErrorMeasures::p95_abs_db},
     {"largest_abs_db", "largest |error|", &ErrorMeasures::largest_abs_db},
     {"bias_db", "bias (mean error)", &ErrorMeasures::bias_db},
     {"at_peak_db", "error at the reference's peak", &ErrorMeasures::at_peak_db}}};
inline constexpr std::array<NamedMeasure, 3> all_rows_measures{
    {{"relative_error", "relative error of complex S", &ErrorMeasures::relative_error},
     {"austin_db", "Austin measure, dB, floor 80 dB below the peak", &ErrorMeasures::austin_db},
     {"correlation", "correlation of the dB curves, same floor", &ErrorMeasures::correlation}}};

/// The measures of a channel whose reference is not zero throughout; rows whose reference is within `within_db` [dB] of its peak
/// are near enough to it.
ErrorMeasures measure_errors(const ChannelPair& pair, double within_db);

/// The value below which the share `q` of the values lies, linear between neighbours in order (0.5: the median).
double quantile(std::vector<double> values, double q);

/// Pearson's correlation coefficient; NaN if one of them does not vary.
double correlation(std::span<const double> a, std::span<const double> b);

}  // namespace raytube
