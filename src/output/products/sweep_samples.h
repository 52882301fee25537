// Stored results as profiles and images take them.
#pragma once

#include <string>

#include "imaging/sweep_grid.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// The rows of a result. Where it holds no errors in metres they follow from its levels. Throws InputError that begins with
/// `name` for frequencies that are not in even steps.
SweepSamples samples_of(const StoredResult& result, const std::string& name);

/// Its looks by the angles to the transmitter. Throws InputError that begins with `name` for bistatic looks, and as angle_grid
/// does.
AngleGrid grid_of_looks(const StoredResult& result, const std::string& name);

}  // namespace raytube
