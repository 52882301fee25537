// The stochastic yardstick: the same case by random tubes, several times over, beside its deterministic solution.
#pragma once

#include "scene/random_result.h"
#include "solve/solve.h"

namespace raytube {

/// Solves the sweep, then repeats it with random tubes (sbr/random_tubes.h) in the place of the solver's. Whatever edges add is
/// taken over from the solution: the two differ by tubes alone. Random tubes see flat facets. Runs differ in their random
/// numbers; the same bytes for any number of threads. Throws InputError for a sweep that solve() refuses, and for edges.method
/// utd; Interrupted when `progress` says stop.
RandomResult solve_with_random_tubes(const Target& target, const Sweep& sweep, const SolveOptions& options,
                                     const RandomOptions& random);

}  // namespace raytube
