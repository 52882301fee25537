// What the rows of a result hold, all together and in windows that slide along the swept angle.
#pragma once

#include <span>
#include <vector>

#include "output/charts/chart_data.h"

namespace raytube {

/// Of levels of sigma, each of which counts once. Zeros count in all but the deviation.
struct SigmaSummary {
  std::size_t rows = 0;
  double mean_m2 = 0.0;  // of sigma, not of its decibels
  double median_dbsm = 0.0;
  double deviation_db = 0.0;  // standard deviation of the decibels, of n - 1; NaN for fewer than two
  std::vector<double> percentiles_dbsm;

  double mean_dbsm() const;
};

/// Percentiles lie between levels by linear interpolation in dB (definition 7 of Hyndman and Fan, Am. Stat. 50 (1996) 361).
SigmaSummary sigma_summary(std::vector<double> dbsm, std::span<const double> percentiles);

/// One window of a cut.
struct WindowRows {
  double from, to;
  std::vector<std::size_t> rows;
};

/// Windows of this width about each row of the cut, those that lie within it; over azimuths all round they run on over its ends.
std::vector<WindowRows> sliding_windows(const CutRows& cut, RowCoordinates::Quantity axis, double width);

/// Throws InputError unless such windows fit into the result's sweep over an angle.
void require_windows(const ChartResult& result, double width);

std::vector<double> levels_of_rows(const ChartResult& result, std::size_t channel, std::span<const std::size_t> rows);

}  // namespace raytube
