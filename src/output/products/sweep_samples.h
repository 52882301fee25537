// Stored results as profiles and images take them.
#pragma once

#include <string>

#include "imaging/sweep_grid.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// The rows of a result. Where it holds no errors in metres they follow from its levels. Throws InputError that begins with
/// `name` for frequencies that are not in even steps, and for a mechanism that the result does not hold; empty: all together.
SweepSamples samples_of(const StoredResult& result, const std::string& name, const std::string& mechanism = "");

/// Numerical error and model uncertainty of |S| [m], which follow from the levels of a result that does not hold them.
std::vector<ChannelErrors> errors_in_metres(const StoredResult& result);
std::vector<ChannelErrors> model_in_metres(const StoredResult& result);

/// Its looks by the angles to the transmitter, or the places of one that is moved along a line or over a plane. Throws InputError
/// that begins with `name` for bistatic looks, and as angle_grid does.
AngleGrid grid_of_looks(const StoredResult& result, const std::string& name);

}  // namespace raytube
