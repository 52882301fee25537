// Scattering centres as netCDF.
#pragma once

#include <filesystem>

#include "output/netcdf/stored_result.h"
#include "output/products/centres_csv.h"

namespace raytube {

/// What centres.csv has, in every digit, with what `result` says of the case. Throws as write_netcdf does.
void write_centres_netcdf(const std::filesystem::path& file, const StoredResult& result, const ScatteringCentres& found,
                          const CentreLook& look, const PartOfTriangle& part_of,
                          const std::vector<std::array<dvec3, 2>>& outline);

}  // namespace raytube
