// Lists of looks: look.looks_csv.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/sweep.h"

namespace raytube {

/// Looks of a CSV file with the header theta_deg,phi_deg or theta_deg,phi_deg,rx_theta_deg,rx_phi_deg; '#' starts a comment
/// line. Sets `bistatic` when receive angles are given. Throws InputError with the line.
std::vector<Look> read_looks_csv(const std::filesystem::path& file, bool& bistatic);

}  // namespace raytube
