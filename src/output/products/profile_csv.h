// Range profiles as a table.
#pragma once

#include <filesystem>

#include "imaging/range_profile.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// profile.csv: one row per look and range, looks slowest: complex amplitude and sigma of the four channels, and what numerical
/// error and model uncertainty come to if all of either were at one range. Looks are those of `result`.
void write_profile_csv(const std::filesystem::path& file, const StoredResult& result, const RangeProfiles& profiles,
                       const Window& window);

}  // namespace raytube
