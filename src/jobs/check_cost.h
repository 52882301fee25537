// What a run of a case costs, as check tells it.
#pragma once

#include "case/data/case.h"
#include "jobs/check_lines.h"
#include "plan/plan.h"

namespace raytube {

/// Looks and tubes, or rays.
void tell_cost(CheckReport& report, const SolvePlan& plan);

/// What it takes at most.
void tell_memory(CheckReport& report, const SolvePlan& plan, const Case& c);

}  // namespace raytube
