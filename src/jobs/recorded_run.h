// What run.json says of the run that wrote it.
#pragma once

#include <string>
#include <vector>

#include "core/ordered_json.h"

namespace raytube {

/// The settings that the run had, those of --set among them, as overrides of its case file.
std::vector<std::string> settings_of_run(const Json& run);

/// SHA-256 of its mesh files; empty if it says none.
std::vector<std::string> mesh_sha256_of_run(const Json& run);

}  // namespace raytube
