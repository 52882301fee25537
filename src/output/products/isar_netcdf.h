// Images of sweeps as netCDF.
#pragma once

#include <filesystem>

#include "imaging/isar.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// What isar.csv has, in every digit, with what `result`, which the image was made of, says of itself. The place of a cell is the
/// sum of its coordinates times their directions, which are attributes. Throws as write_netcdf does.
void write_isar_netcdf(const std::filesystem::path& file, const StoredResult& result, const IsarImage& image,
                       const Window& window, const std::vector<std::array<dvec3, 2>>& outline = {});

}  // namespace raytube
