// Keys of a case that change nothing.
#pragma once

#include <string>
#include <vector>

#include "case/data/case.h"
#include "plan/plan.h"

namespace raytube {

/// A sentence for each key of [edges] that is written but has no effect on this target: where it is, why, what to do. A key that
/// forbids what would not happen anyway is none, nor is one of the file when the command line turns edges off altogether.
std::vector<std::string> idle_key_warnings(const Case& c, const SolvePlan& plan);

}  // namespace raytube
