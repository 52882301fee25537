// What a run of a case would do, without doing it.
#pragma once

#include <string>

#include "case/data/case.h"
#include "jobs/check_lines.h"
#include "mesh/model/triangle_mesh.h"
#include "plan/plan.h"
#include "solve/probe.h"

namespace raytube {

/// "0.12 s", "17 min"
std::string seconds_text(double seconds);

/// The resolved case, mesh, wedges, curved surfaces, what is skipped, warnings, cost and memory. The plan is that of the case.
void tell_case(CheckReport& report, const Case& c, const MeshReport& counts, const SolvePlan& plan);

/// How long it will take, from looks that are timed for some seconds.
TimePrediction tell_time(CheckReport& report, const SolvePlan& plan);

}  // namespace raytube
