// Case file -> Case.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "case/data/case.h"
#include "case/directions/looks_csv.h"
#include "case/text/document.h"

namespace raytube {

/// Reads a case; `overrides` are "dotted.key=value" with values in TOML syntax, applied before anything is checked.
/// Throws InputError with file, line or key, and the remedy.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// A case of values that no file holds; sentences call it `name`, and files are looked for in the current folder. `looks` stand
/// in the place of [look] and [receive], if there are any. Throws InputError as above.
Case case_of_values(const CaseValue& root, const std::string& name, const LookNumbers* looks = nullptr);

/// The files that the case is read from, each with the key that names it.
std::vector<std::pair<std::string, std::filesystem::path>> input_files(const Case& c);

}  // namespace raytube
