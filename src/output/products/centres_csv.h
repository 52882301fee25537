// Scattering centres as a table, and as points in space.
#pragma once

#include <filesystem>

#include "imaging/centres.h"

namespace raytube {

/// What centres are of.
struct CentreLook {
  Direction direction;  // towards the radar
  double frequency;     // [Hz]
  double side;          // of the cube that is resolved [m]
};

/// centres.csv: one row per centre, the strongest first, then `rest`, without a place: with it the rows add up to S of the look.
void write_centres_csv(const std::filesystem::path& file, const ScatteringCentres& found, const CentreLook& look);

/// centres.ply: points in the mesh's coordinates [m] with the larger co-polar sigma [dBsm], coloured by it over 40 dB.
void write_centres_ply(const std::filesystem::path& file, const ScatteringCentres& found);

}  // namespace raytube
