// Which curves a sweep is drawn as: rows that differ in one quantity only form a cut.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Direction, time and frequency of the rows of a result. Quantities in the order in which they are preferred as the axis of a
/// curve.
struct RowCoordinates {
  enum Quantity { phi, theta, rx_phi, rx_theta, time, frequency, look_number, quantities };
  std::vector<std::array<double, quantities>> rows;  // [degrees, s, GHz]; look_number counts the direction pairs
  std::array<bool, quantities> told{};               // which ones are told of a row; the receiver's only when it differs
};

/// Makes values equal that differ by no more than the rounding of whoever computed them.
void merge_equal_values(RowCoordinates& coordinates);

/// Rows in the order of every output: looks slowest, frequency fastest.
RowCoordinates coordinates_of_rows(const Sweep& sweep);

/// Rows that differ in one quantity only, ordered by it.
struct CutRows {
  std::string fixed;  // the others: "10 GHz, θ = 90°"
  std::vector<std::size_t> rows;
  std::vector<double> x;
};

struct CutPlan {
  RowCoordinates::Quantity quantity = RowCoordinates::phi;
  std::string axis;  // label with unit
  std::vector<CutRows> cuts;
};

/// Rows that differ in this quantity only, ordered by it; the groups in the order of their first row.
std::vector<std::vector<std::size_t>> rows_along(RowCoordinates::Quantity quantity, const RowCoordinates& coordinates);

/// "azimuth φ (degrees)"
std::string axis_label(RowCoordinates::Quantity quantity);

/// Takes the quantity that leaves the fewest cuts as the axis, or the look's number if no quantity orders the looks.
CutPlan plan_cuts(const RowCoordinates& coordinates);

/// The coordinates of a row in words: "10 GHz, θ = 90°, φ = 12°".
std::string coordinates_text(const RowCoordinates& coordinates, std::size_t row);

/// At most `most` of `count` cuts, evenly spread from the first to the last.
std::vector<std::size_t> spread_choice(std::size_t count, std::size_t most);

/// Curves over one quantity, the others held fixed.
struct Cut {
  std::string fixed;  // "10 GHz, θ = 90°"
  std::vector<double> x;
  std::array<std::vector<double>, 4> sigma_dbsm;                    // VV, VH, HV, HH
  std::vector<std::size_t> rows{};                                  // of the sweep; empty: not told
  RowCoordinates::Quantity quantity = RowCoordinates::look_number;  // of x
};

struct Cuts {
  std::string axis;  // label with unit
  std::vector<Cut> cuts;
  std::size_t total = 0;  // cuts of the sweep; `cuts` holds a few of them if there are too many to draw
};

/// The row of the largest amplitude in any channel, the first one of equals.
std::size_t peak_row(const SweepResult& result);

/// The curves of plan_cuts, or a few of them, evenly spread, with that through the peak.
Cuts choose_cuts(const Sweep& sweep, const SweepResult& result, std::size_t most_cuts);

}  // namespace raytube
