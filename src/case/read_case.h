// Case file -> Case.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "case/data/case.h"

namespace raytube {

/// Reads a case; `overrides` are "dotted.key=value" with values in TOML syntax, applied before anything is checked.
/// Throws InputError with file, line or key, and the remedy.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The files that the case is read from, each with the key that names it.
std::vector<std::pair<std::string, std::filesystem::path>> input_files(const Case& c);

}  // namespace raytube
