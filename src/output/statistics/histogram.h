// How many rows have which sigma, beside what fitted laws say.
#pragma once

#include <span>
#include <vector>

#include "output/statistics/laws.h"

namespace raytube {

struct HistogramBin {
  double from_dbsm, to_dbsm;  // the first one may begin at -inf
  std::size_t rows;
};

struct Histogram {
  double width_db = 0.0;
  std::size_t rows = 0;
  std::vector<HistogramBin> bins;
};

/// Bins of 0.5, 1, 2 or 5 dB, about as wide as Freedman and Diaconis (1981) ask for; whatever is more than 60 dB below the peak
/// lies in the first one. Empty if all levels are zero.
Histogram histogram_of(std::span<const double> dbsm);

/// The share of the rows that a law expects in a bin.
double expected_share(const LawFit& law, const HistogramBin& bin);

}  // namespace raytube
