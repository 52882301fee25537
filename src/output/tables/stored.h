// Results on their way into files of any kind and back.
#pragma once

#include <filesystem>
#include <string>

#include "output/netcdf/stored_result.h"
#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Its frequencies and looks, without S.
StoredResult stored_sweep(const Sweep& sweep);

/// All that files say of a solve. `note` is a further comment line of rcs.csv, or empty. Attributes are the caller's.
StoredResult stored(const Sweep& sweep, const SweepResult& result, const std::string& note = "");

/// Bytes that stored() takes for each row, and its way into a file, with so many columns of mechanisms; 0: they are not kept.
double stored_bytes_per_row(std::size_t columns);

/// What was asked for, as far as a file says it: frequencies and looks, without antennas and materials.
Sweep sweep_of(const StoredResult& result);

/// Whether a table has the columns of rcs.csv, in their order.
bool has_rcs_columns(const std::filesystem::path& file);

/// Reads rcs.csv as a run writes it, from the numbers to the comment lines. Throws InputError, with the line, if it has other
/// columns or if its rows are not every look at every frequency, frequency fastest.
StoredResult read_rcs_csv(const std::filesystem::path& file);

}  // namespace raytube
