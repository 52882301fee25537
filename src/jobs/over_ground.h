// A case over ground: solved along its paths, which are added up.
#pragma once

#include "case/data/case.h"
#include "plan/plan.h"
#include "scene/results.h"

namespace raytube {

/// The plan of a solve of the case: of its sweep, or over ground of the sweep along its paths, with parts kept. Throws InputError
/// as SolvePlan does.
SolvePlan planned(const Target& target, const Case& c, const SolveOptions& options);

/// What a solve of such a plan gives, as the rows of the case. Over ground errors add up as amplitudes do, so that none is too
/// small where all paths are alike. `keep_parts`: asked for by the user.
SweepResult result_of_case(const Case& c, SweepResult solved, bool keep_parts);

/// Throws InputError if the case has a ground: `what` knows of none.
void refuse_ground(const Case& c, const std::string& what);

}  // namespace raytube
