// The report of `raytube check` for people.
#pragma once

#include <string>

#include "core/ordered_json.h"

namespace raytube {

/// "0.12 s", "17 min"
std::string seconds_text(double seconds);

/// The sections that check_data, time_data and ranks_data (check_report.h) have made, each alone or together.
std::string check_text(const Json& data);

}  // namespace raytube
