// What a case asks that it hardly means, or that its target does not bear out.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "plan/plan.h"
#include "scene/validity.h"

namespace raytube {

/// How large a target is, and its features, against the wavelengths it is looked at with; `outermost` are points of the target as
/// wide as all of it (scene/sampling.h).
Validity validity_of(const Target& target, const Sweep& sweep, std::span<const dvec3> outermost);

/// Sentences about ranges that end before their stop, bodies with holes, layers without room, features too small for the methods,
/// steps too wide for the lobes, and keys without effect, each with its remedy; of a target as wide as these points of it. The
/// plan is that of the case.
std::vector<std::string> warnings_of(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost);

}  // namespace raytube
