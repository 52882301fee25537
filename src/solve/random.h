// The Monte Carlo baseline: the same case by random tubes, several times over, beside its deterministic solution.
#pragma once

#include "plan/plan.h"
#include "scene/random_result.h"

namespace raytube {

/// Throws InputError, naming the remedy, for what random tubes cannot do: rays in the place of currents, too few of
/// them.
void check_random_tubes(const SolvePlan& plan, const RandomOptions& random);

/// Solves the plan, which keeps parts, then repeats it with random tubes (sbr/random_tubes.h) in the place of the solver's.
/// Whatever edges add is taken over from the solution: the two differ by tubes alone. Random tubes see flat facets. Runs differ
/// in their random numbers; the same bytes for any number of threads. Throws InputError as check_random_tubes() does, Interrupted
/// when `progress` (as for solve()) says stop. `team`: as of solve(); the others help_with_random_tubes().
RandomResult solve_with_random_tubes(const SolvePlan& plan, const RandomOptions& random,
                                     const std::function<bool(double)>& progress = {}, WorkTeam* team = nullptr);

/// Computes looks and random tubes for the process that leads the team and solves the same.
void help_with_random_tubes(const SolvePlan& plan, const RandomOptions& random, WorkTeam& team);

/// Plans first; throws InputError as SolvePlan does, too.
RandomResult solve_with_random_tubes(const Target& target, const Sweep& sweep, const SolveOptions& options,
                                     const RandomOptions& random);

}  // namespace raytube
