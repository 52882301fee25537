#include "output/charts/ordinate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr double decibel_step = 10.0, least_range_db = 10.0;  // less would show rounding

}  // namespace

double Ordinate::of(double sigma_dbsm) const {
  if (unit == ChartUnit::square_metres) return std::pow(10.0, sigma_dbsm / 10.0);
  return std::max(sigma_dbsm - (unit == ChartUnit::db_of_peak ? peak_dbsm : 0.0), bottom - 2.0 * decibel_step);
}

const char* Ordinate::label() const {
  return unit == ChartUnit::dbsm ? "σ (dBsm)" : unit == ChartUnit::square_metres ? "σ (m²)" : "σ (dB below the peak)";
}

std::string angle_tics(char axis, RowCoordinates::Quantity quantity, double extent, double step) {
  const bool angle = quantity != RowCoordinates::frequency && quantity != RowCoordinates::look_number;
  return angle && extent >= 180.0 ? fmt::format("set {}tics {}\n", axis, step) : "";
}

double round_step(double extent) {
  const double quarter = extent / 4.0, decade = std::pow(10.0, std::floor(std::log10(quarter)));
  return decade * (quarter < 2.0 * decade ? 1.0 : quarter < 5.0 * decade ? 2.0 : 5.0);
}

Ordinate ordinate(const ChartOptions& options, double peak_dbsm, double lowest_dbsm, double most_range_db) {
  if (!std::isfinite(peak_dbsm)) peak_dbsm = 0.0, lowest_dbsm = -most_range_db;  // nothing comes back at all
  if (options.unit == ChartUnit::square_metres) {
    const double peak = std::pow(10.0, peak_dbsm / 10.0), step = round_step(peak);
    return {options.unit, peak_dbsm, 0.0, step * std::ceil(1.02 * peak / step), step};
  }
  const double peak = options.unit == ChartUnit::dbsm ? peak_dbsm : 0.0, lowest = lowest_dbsm - peak_dbsm + peak;
  const double range = options.range_db.value_or(std::clamp(peak - lowest, least_range_db, most_range_db));
  const double bottom = options.range_db ? peak - range : decibel_step * std::floor((peak - range) / decibel_step);
  return {options.unit, peak_dbsm, bottom, 5.0 * std::ceil((peak + 2.0) / 5.0), decibel_step};
}

}  // namespace raytube
