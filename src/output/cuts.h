// Which curves a sweep is drawn as: rows that differ in one quantity only form a cut.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sweep.h"

namespace raytube {

/// Curves over one quantity, the others held fixed.
struct Cut {
  std::string fixed;  // "10 GHz, θ = 90°"
  std::vector<double> x;
  std::array<std::vector<double>, 4> sigma_dbsm;  // VV, VH, HV, HH
};

struct Cuts {
  std::string axis;  // label with unit
  std::vector<Cut> cuts;
  std::size_t total = 0;  // cuts of the sweep; `cuts` holds a few of them, evenly spread, if there are too many to draw
};

/// Takes the quantity that leaves the fewest cuts as the axis, or the look's number if no quantity orders the looks.
Cuts choose_cuts(const Sweep& sweep, const SweepResult& result, std::size_t most_cuts);

}  // namespace raytube
