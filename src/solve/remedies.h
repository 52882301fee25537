// What would make a part of the model uncertainty less, what that costs, and whether it is worth naming.
#pragma once

#include <string>
#include <vector>

#include "plan/plan.h"
#include "uncertainty/omissions.h"

namespace raytube {

/// What the mechanism says that is there for it, of which `shown` tells by its place in the plan; the tubes for what they leave
/// out; else what is written beside the omission.
std::string remedy_of(Omission omission, const SolvePlan& plan, const Statistics& statistics,
                      const std::vector<MechanismShown>& shown);

}  // namespace raytube
