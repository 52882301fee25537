// Antenna patterns: radar.pattern_csv.
#pragma once

#include <filesystem>

#include "scene/antenna.h"

namespace raytube {

/// Cuts of an antenna pattern in two planes, from a CSV file with the header angle_deg,azimuth_db,elevation_db: ascending angles
/// off the axis [deg] and levels relative to it [dB]. Throws InputError with the line.
void read_pattern_csv(const std::filesystem::path& file, AntennaPattern& pattern);

}  // namespace raytube
