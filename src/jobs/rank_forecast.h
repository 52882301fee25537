// What a job of several processes would take.
#pragma once

#include "case/data/case.h"
#include "core/ordered_json.h"
#include "plan/plan.h"
#include "solve/probe.h"

namespace raytube {

/// What they may take at most [bytes].
struct RankMemory {
  double leader, other;
};

/// To be asked before looks are timed, which takes memory, too.
RankMemory memory_of_ranks(const SolvePlan& plan, const Case& c);

/// Time and memory of `ranks` processes with the plan's threads each, as a member "ranks". `time`: as predicted for one process.
/// Looks do not end together: whole ones are dealt out.
Json ranks_data(const SolvePlan& plan, const RankMemory& memory, const TimePrediction& time, int ranks);

}  // namespace raytube
