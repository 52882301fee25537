// Curves too coarse for their lobes in short: what most of the rows about a point hold.
#pragma once

#include <optional>
#include <span>

#include "output/tables/cuts.h"

namespace raytube {

/// What a tenth, half and nine tenths of the rows of a sector do not exceed [dBsm].
struct SectorLevels {
  double low, median, high;
};

/// A sector about each point of a curve that has one of full width.
struct SlidingSectors {
  double width = 0.0;  // in the unit of x
  std::vector<double> x;
  std::array<std::vector<SectorLevels>, 4> levels;  // of the channels
};

/// Whether azimuths in ascending order go all round, without a gap of more than 10 degrees.
bool goes_round(std::span<const double> degrees);

/// Sectors of ten steps, or of a thirty-sixth of the rows where that is more: 10 degrees of a full circle. On a full circle they
/// run on over its ends. None of curves that are not in even steps, that are shorter than two sectors, or that are over numbers.
std::optional<SlidingSectors> sliding_sectors(const Cut& cut);

}  // namespace raytube
