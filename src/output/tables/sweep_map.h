// Sweeps over two quantities.
#pragma once

#include <limits>
#include <optional>

#include "output/tables/cuts.h"

namespace raytube {

/// Rows of a grid over two quantities, all others held fixed.
struct SweepMap {
  static constexpr std::size_t hole = std::numeric_limits<std::size_t>::max();  // in the place of a row that is not there
  RowCoordinates::Quantity across, up;
  std::vector<double> x, y;       // their values, ascending
  std::vector<std::size_t> rows;  // at x[i], y[j]: rows[j * x.size() + i]
  std::string fixed;              // the others: "10 GHz"
  std::size_t held = 0;           // rows of the sweep at these others, repeated ones counted
};

/// The grid that holds this row, along the axis of `plan` and the other quantity with the most values. None if that has no more
/// than `most_cuts` of them, or if the rows neither fill half of a grid nor have three values of the axis for each of the other: steps of azimuth
/// that grow towards the poles, say; then the row with the most values gives the grid, and the others' rows stand where they are
/// the nearest ones. Of rows that are repeated it holds the first.
std::optional<SweepMap> map_through(std::size_t row, const RowCoordinates& coordinates, const CutPlan& plan,
                                    std::size_t most_cuts);

}  // namespace raytube
