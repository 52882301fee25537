// A result of a single row in words: what a picture of one point would not show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/netcdf/stored_result.h"
#include "output/tables/result_table.h"

namespace raytube {

/// Level, phase, numerical error and model uncertainty of each channel asked for, all of them if none is; the errors are told of
/// a result with such columns. Needs a table of one row.
std::string look_table(const ResultTable& table, const std::optional<StoredResult>& stored,
                       const std::vector<std::size_t>& channels);

}  // namespace raytube
