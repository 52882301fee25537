// Range profiles as netCDF.
#pragma once

#include <filesystem>

#include "imaging/range_profile.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// What profile.csv has, in every digit, with what `result`, whose looks these are, says of itself. Throws as write_netcdf does.
void write_profile_netcdf(const std::filesystem::path& file, const StoredResult& result, const RangeProfiles& profiles,
                          const Window& window);

}  // namespace raytube
