// Sweeps over two quantities.
#pragma once

#include <optional>

#include "output/tables/cuts.h"

namespace raytube {

/// Rows of a grid over two quantities, all others held fixed.
struct SweepMap {
  RowCoordinates::Quantity across, up;
  std::vector<double> x, y;       // their values, ascending
  std::vector<std::size_t> rows;  // at x[i], y[j]: rows[j * x.size() + i]
  std::string fixed;              // the others: "10 GHz"
};

/// The grid that holds this row, along the axis of `plan` and the other quantity with the most values. None if that has no more
/// than `most_cuts` of them, or if the rows form no grid.
std::optional<SweepMap> map_through(std::size_t row, const RowCoordinates& coordinates, const CutPlan& plan,
                                    std::size_t most_cuts);

}  // namespace raytube
