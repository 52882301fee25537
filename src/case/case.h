// Case file (TOML) -> Case: strict keys, units converted, every default resolved.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solve.h"

namespace raytube {

/// The look section as the user gave it [deg]: either the name of a look list, relative to the case's folder, or the values of
/// each angle.
struct LookChoice {
  std::string looks_csv;
  std::vector<double> theta_deg, phi_deg;
  std::vector<double> rx_theta_deg, rx_phi_deg;  // empty when monostatic
};

/// The radar section as the user gave it; no range and no position: the far field.
struct RadarChoice {
  double range_m = 0.0, receive_range_m = 0.0;
  std::vector<dvec3> positions, receive_positions;  // [m]
  std::vector<double> beamwidth_deg;                // azimuth, elevation
  std::string pattern_csv;                          // relative to the case's folder
};

struct Case {
  std::string title;
  std::filesystem::path file;
  std::string mesh;                 // as written, relative to the case's folder
  std::filesystem::path mesh_file;  // resolved against it
  std::string unit;                 // as written
  double metres_per_unit = 1.0;
  Sweep sweep;
  LookChoice looks;
  RadarChoice radar;
  TubeOptions tubes;
  EdgeOptions edges;
  bool plots = true;
  std::vector<std::size_t> image_looks;  // of which images are made
  double image_per_wavelength = 10.0;
};

/// The files that the case is read from, each with the key that names it.
std::vector<std::pair<std::string, std::filesystem::path>> input_files(const Case& c);

/// Reads a case; `overrides` are "dotted.key=value" with values in TOML syntax, applied before anything is checked.
/// Throws InputError with file, line or key, and the remedy.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The resolved case with every default filled in, as JSON text with the case file's keys and units. File names stay relative
/// to the case file's folder, so that it can be read as a case there.
std::string resolved_case_json(const Case& c);

/// The same key by key ("tubes.mode" and its value in JSON), but for the title and [output], on which no amplitude depends.
std::vector<std::pair<std::string, std::string>> numerical_keys(const Case& c);

}  // namespace raytube
