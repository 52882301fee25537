// What a report says in words: what a result holds, how sure it is, and the record of its run.
#pragma once

#include "core/json.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// Peak, numerical error and model uncertainty. `run`: what run.json says, or null.
JsonValue sentences_json(const StoredResult& result, const JsonValue& run);

/// Settings, mesh, counts, warnings, what was skipped and the parts of the model uncertainty, as run.json has them; long lists as
/// their extent.
JsonValue record_json(const JsonValue& run);

}  // namespace raytube
