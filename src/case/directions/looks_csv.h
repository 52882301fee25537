// Lists of looks: look.looks_csv, or numbers from elsewhere.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/sweep.h"

namespace raytube {

/// Looks of a CSV file with the header theta_deg,phi_deg[,rx_theta_deg,rx_phi_deg] or
/// azimuth_deg,elevation_deg[,rx_azimuth_deg,rx_elevation_deg]; '#' starts a comment line. Sets `bistatic` when receive angles
/// are given. Throws InputError with the line.
std::vector<Look> read_looks_csv(const std::filesystem::path& file, bool& bistatic);

/// Looks as numbers [deg]: theta, phi to the transmitter, then those to the receiver, equal unless `bistatic`.
struct LookNumbers {
  bool bistatic = false;
  std::vector<std::array<double, 4>> rows;
};

/// The same as looks. Throws InputError, which begins with `location` and names the row, counted from 0.
std::vector<Look> looks_of_numbers(const LookNumbers& numbers, const std::string& location);

}  // namespace raytube
