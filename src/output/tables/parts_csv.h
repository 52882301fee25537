// parts.csv, read back.
#pragma once

#include <filesystem>
#include <vector>

#include "output/netcdf/stored_result.h"

namespace raytube {

/// S by mechanism, of a table beside rcs.csv with the rows of `result`. Throws InputError if these are others, or if a column is
/// no number.
std::vector<StoredPart> read_parts_csv(const std::filesystem::path& file, const StoredResult& result);

}  // namespace raytube
