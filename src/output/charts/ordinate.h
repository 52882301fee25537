// The axis of sigma: its unit, from where to where it goes.
#pragma once

#include <string>

#include "output/charts/chart_data.h"

namespace raytube {

struct Ordinate {
  ChartUnit unit;
  double peak_dbsm;
  double bottom, top, step;  // in the unit

  /// A level in the unit; of decibels no less than a little below the bottom, so that a line leaves through it.
  double of(double sigma_dbsm) const;

  /// "σ (dBsm)"
  const char* label() const;
  bool decibels() const { return unit != ChartUnit::square_metres; }
};

/// For levels with this peak, of which all but nulls lie above `lowest_dbsm`. A range is told below the peak; without one it goes
/// down to the lowest one, but by no more than `most_range_db`.
Ordinate ordinate(const ChartOptions& options, double peak_dbsm, double lowest_dbsm, double most_range_db);

/// "set xtics 30": of angles over half a turn and more; otherwise gnuplot's own.
std::string angle_tics(char axis, RowCoordinates::Quantity quantity, double extent, double step);

/// 1, 2 or 5 times a power of ten, about a quarter of the extent.
double round_step(double extent);

}  // namespace raytube
