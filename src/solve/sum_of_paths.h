// A solve over ground: its rows are sums over paths.
#pragma once

#include "plan/plan.h"
#include "scene/results.h"

namespace raytube {

/// The rows asked for of a plan over ground, from those along its paths. Errors add up as amplitudes do.
SweepResult sum_of_paths(const SolvePlan& plan, SweepResult solved);

/// The same of some amplitudes of any plan [m]: those of one that has no ground as they are.
std::vector<ScatteringMatrix> sum_of_paths(const SolvePlan& plan, std::vector<ScatteringMatrix> rows);

}  // namespace raytube
