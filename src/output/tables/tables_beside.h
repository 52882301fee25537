// What a run keeps in tables beside rcs.csv, read back.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "output/netcdf/stored_result.h"

namespace raytube {

/// parts.csv: S by mechanism, in the rows of `result`. Throws InputError if its rows are others, or if a column is no number.
std::vector<StoredPart> read_parts_csv(const std::filesystem::path& file, const StoredResult& result);

/// incoherent.csv: sigma [m^2] by transmit polarisation; otherwise as read_parts_csv.
std::vector<std::array<double, 2>> read_incoherent_csv(const std::filesystem::path& file, const StoredResult& result);

}  // namespace raytube
