// What a job of several processes would take.
#pragma once

#include "case/data/case.h"
#include "jobs/check_report.h"
#include "solve/probe.h"

namespace raytube {

/// What they may take at most [bytes].
struct RankMemory {
  double leader, other;
};

/// To be asked before looks are timed, which takes memory, too.
RankMemory memory_of_ranks(const SolvePlan& plan, const Case& c);

/// Time and memory of so many ranks, each with the plan's threads. `time`: as predicted for one process. Looks do not come to an
/// end together: whole ones are dealt out.
void tell_ranks(CheckReport& report, const SolvePlan& plan, const RankMemory& memory, const TimePrediction& time, int ranks);

}  // namespace raytube
