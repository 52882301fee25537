// The public API: a target, a sweep and options in; complex polarimetric amplitudes out.
//
// Notation. S_pq [m], p received, q transmitted (V = theta_hat, H = phi_hat of the direction in question): E_p^s = S_pq E_q^i
// e^{-jkr} / r, time factor e^{+j omega t}, phase reference at the origin of the mesh's own coordinates (core/field.h). For every
// look
//   S = sum over bounces m of the physical-optics currents that tubes of rays light     (sbr/sbr.h)
//     + fringe currents of lit edges, and what these start at further edges             (utd/edge_sets.h)
//     + currents that edge-diffracted waves excite on other faces                       (utd/interaction/edge_face_interaction.h)
#pragma once

#include "core/error.h"  // what is thrown, for whoever catches it
#include "plan/plan.h"
#include "plan/target.h"
#include "scene/results.h"

namespace raytube {

/// S of every row of the plan's sweep. The same bytes for any number of threads. `progress` is called now and then with the
/// finished share (0 to 1) and returns false to stop; `kept` takes finished looks and gives them back to a later solve of the
/// same plan. Throws Interrupted when `progress` says stop.
SweepResult solve(const SolvePlan& plan, const std::function<bool(double)>& progress = {}, const KeptLooks& kept = {});

/// Plans and solves. Throws InputError as SolvePlan does, Interrupted as above.
SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options = {});

}  // namespace raytube
