// centres.csv, read back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/field.h"

namespace raytube {

struct StoredCentre {
  dvec3 place;         // [m]
  ScatteringMatrix s;  // [m]
  std::string mechanism, part;
  double persistence_ghz = 0.0, persistence_azimuth_deg = 0.0, persistence_elevation_deg = 0.0;
};

struct StoredCentres {
  double theta_deg = 0.0, phi_deg = 0.0;  // of the look
  double frequency = 0.0;                 // [Hz]
  double side = 0.0;                      // of the cube that is resolved [m]
  std::vector<StoredCentre> centres;      // the strongest first
  ScatteringMatrix s;                     // of the look, all rows together [m]
};

/// Throws InputError for a table that raytube has not written.
StoredCentres read_centres_csv(const std::filesystem::path& file);

}  // namespace raytube
