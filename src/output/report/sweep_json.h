// The rows of a result as the page of a report takes them: curves by channel and mechanism, and a map.
#pragma once

#include "core/json.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// Frequencies, looks, and of each row sigma and both errors [dB] of the four channels, sigma of each part, too. Of a sweep too
/// large for a page the strongest and the weakest of every few neighbours along its curves.
JsonValue sweep_json(const StoredResult& result);

/// sigma over the two quantities of a sweep that has two; else null. It lies on the grid that holds the peak. Throws InputError
/// that begins with `name` for uneven steps.
JsonValue map_json(const StoredResult& result, const std::string& name);

}  // namespace raytube
