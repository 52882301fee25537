// What a run of a case would do, without doing it: as data, from which check_text.h makes the text.
#pragma once

#include "case/data/case.h"
#include "core/ordered_json.h"
#include "jobs/memory.h"
#include "jobs/moving.h"
#include "mesh/model/triangle_mesh.h"
#include "plan/plan.h"
#include "solve/probe.h"

namespace raytube {

/// The case, its size, mesh, materials, wedges, curved surfaces, mechanisms, what is skipped, warnings, cost and memory. The plan
/// is that of the case; of one that moves that of case_of_plan, `moving` is its target, and a run solves so many `plans` as this
/// one.
Json check_data(const Case& c, const MeshReport& counts, const SolvePlan& plan, const MovingTarget* moving, std::size_t plans);

/// How many plans as this one a run solves.
std::size_t plans_of(const Case& c, const MovingTarget* moving);

/// How long the run will take, from looks that are timed for some seconds: a member "time".
Json time_data(const SolvePlan& plan, const TimePrediction& time);
TimePrediction predicted_time(const SolvePlan& plan, std::size_t plans = 1);

/// Time and memory of `ranks` processes with the plan's threads each: a member "ranks". `memory`: from before looks were timed,
/// which takes memory, too. `time`: as predicted for one process. Looks do not end together: whole ones are dealt out.
Json ranks_data(const SolvePlan& plan, const MemoryOfRun& memory, const TimePrediction& time, int ranks);

}  // namespace raytube
