// What a case asks that it hardly means, or that its target does not bear out.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "plan/plan.h"

namespace raytube {

/// Sentences about ranges that end before their stop, bodies with holes, layers without room, features too small for the methods,
/// steps too wide for the lobes, and keys without effect, each with its remedy; of a target as wide as these points of it
/// (scene/sampling.h). The plan is that of the case.
std::vector<std::string> warnings_of(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost);

}  // namespace raytube
