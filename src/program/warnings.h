// What a case asks that its target does not bear out.
#pragma once

#include <string>
#include <vector>

#include "solve/plan.h"

namespace raytube {

/// Sentences about features too small for the methods and about steps too wide for the lobes, each with its remedy.
std::vector<std::string> warnings_of(const SolvePlan& plan);

}  // namespace raytube
