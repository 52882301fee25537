// A result as a file holds it: in the units of tables, without anything of the solver. What rcs.csv says, and what else is known.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Directions to transmitter and receiver in decimal degrees; their distances from the mesh's origin [m], finite both or neither;
/// the time at which it is taken [s], where the result is of a scene that moves.
struct StoredLook {
  double theta_deg = 0.0, phi_deg = 0.0, rx_theta_deg = 0.0, rx_phi_deg = 0.0;
  double range_m = std::numeric_limits<double>::infinity(), rx_range_m = std::numeric_limits<double>::infinity();
  double time_s = 0.0;

  bool far() const { return std::isinf(range_m); }
  friend bool operator==(const StoredLook&, const StoredLook&) = default;
};

/// S of one mechanism; the name is that of its columns in parts.csv.
struct StoredPart {
  std::string name;
  std::vector<ScatteringMatrix> s;  // [row] [m]
};

/// One part of the model uncertainty.
struct StoredModelPart {
  std::string name;
  std::vector<ChannelErrors> m;  // [row] [m]
};

/// Rows: looks vary slowest, frequency fastest. Inside a row the receive polarisation comes first, V before H. A vector over rows
/// is contiguous: [look][frequency][receive][transmit].
struct StoredResult {
  std::vector<double> frequency_hz;
  std::vector<StoredLook> looks;  // at least one
  bool bistatic = false;
  bool moving = false;  // looks have their times

  std::vector<ScatteringMatrix> s;                          // [m]
  std::vector<ChannelErrors> sigma_dbsm, err_db, model_db;  // as rcs.csv has them; -inf for zero sigma

  // Empty where they are not known.
  std::vector<ChannelErrors> error_m, model_m;  // behind err_db and model_db [m]
  std::vector<StoredPart> parts;
  std::vector<StoredModelPart> model_parts;
  std::vector<std::array<double, 2>> incoherent_m2;  // by transmit polarisation [m^2]

  std::string comment;                                          // the lines before the header of rcs.csv
  std::vector<std::pair<std::string, std::string>> attributes;  // of the whole: name and text

  std::size_t rows() const { return frequency_hz.size() * looks.size(); }
  bool far() const { return looks.front().far(); }
};

}  // namespace raytube
