// What a job of several processes would take.
#pragma once

#include "case/data/case.h"
#include "jobs/check_report.h"
#include "solve/probe.h"

namespace raytube {

/// Time and memory of so many ranks, each with the plan's threads. `time`: as predicted for one process. Looks do not come to an
/// end together: whole ones are dealt out.
void tell_ranks(CheckReport& report, const SolvePlan& plan, const Case& c, const TimePrediction& time, int ranks);

}  // namespace raytube
