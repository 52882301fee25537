// What a case asks that it hardly means, or that its target does not bear out.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "solve/plan.h"

namespace raytube {

/// Sentences about ranges that end before their stop, about features too small for the methods and about steps too wide for the
/// lobes, each with its remedy; of a target as wide as these points of it (scene/sampling.h).
std::vector<std::string> warnings_of(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost);

}  // namespace raytube
