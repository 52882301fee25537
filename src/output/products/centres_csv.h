// Scattering centres as a table, and as points in space.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "imaging/centres.h"

namespace raytube {

/// What centres are of.
struct CentreLook {
  Direction direction;  // towards the radar
  double frequency;     // [Hz]
  double side;          // of the cube that is resolved [m]
};

/// What a triangle of the mesh is part of, by name; empty: of nothing that has one.
using PartOfTriangle = std::function<std::string(std::uint32_t)>;

/// centres.csv: one row per centre, the strongest first, then `rest`, without a place: with it the rows add up to S of the look.
void write_centres_csv(const std::filesystem::path& file, const ScatteringCentres& found, const CentreLook& look,
                       const PartOfTriangle& part_of, const std::string& title = "");

/// by_part.csv: S of a look by the parts that currents are on, the strongest first, then of edges, interaction and waves by
/// mechanism (ScatteringCentres::mechanisms), then of all together.
void write_by_part_csv(const std::filesystem::path& file, const std::vector<ScatteringPiece>& pieces,
                       const std::vector<std::string>& mechanisms, const CentreLook& look, const PartOfTriangle& part_of);

/// centres.ply: points in the mesh's coordinates [m] with the larger co-polar sigma [dBsm], coloured by it over 40 dB.
void write_centres_ply(const std::filesystem::path& file, const ScatteringCentres& found);

}  // namespace raytube
