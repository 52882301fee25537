// A case as it was understood, every default filled in.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/data/case.h"
#include "core/ordered_json.h"

namespace raytube {

/// The resolved case with the case file's keys and units. File names stay relative to the case file's folder, so that it can be
/// read as a case there.
Json resolved_case(const Case& c);
std::string resolved_case_json(const Case& c);

/// A resolved case key by key, "tubes.mode" and its value in JSON, without the title and [output], on which no amplitude depends.
std::vector<std::pair<std::string, std::string>> numerical_keys(const Json& resolved);
std::vector<std::pair<std::string, std::string>> numerical_keys(const Case& c);

}  // namespace raytube
