// The public API: a target, a sweep and options in; complex polarimetric amplitudes out.
//
// Notation. S_pq [m], p received, q transmitted (V = theta_hat, H = phi_hat of the direction in question): E_p^s = S_pq E_q^i
// e^{-jkr} / r, time factor e^{+j omega t}, phase reference at the origin of the mesh's own coordinates (core/field.h). For every
// look
//   S = physical-optics currents of every bounce of the tubes                (sbr/sbr.h)
//     + fringe currents of lit edges, with multiple diffraction              (utd/edge_sets.h)
//     + corner waves along edges                                             (utd/corner/corner_waves.h)
//     + edge-face interaction: edge-diffracted illumination of other faces   (utd/interaction/edge_face_interaction.h)
//     + waves over curved surfaces                                           (utd/surface/surface_waves.h)
//     + rounded edges, and tips that are flat or round                       (utd/rounded/rims.h, utd/tip)
//     + edges of materials                                                   (utd/fringe/material_edges.h)
// Screens transmit part of what tubes and edge currents behind them radiate.
#pragma once

#include "core/error.h"  // what is thrown, for whoever catches it
#include "core/work_team.h"
#include "plan/plan.h"
#include "plan/target.h"
#include "scene/results.h"
#include "solve/shard.h"

namespace raytube {

/// S of every row of the sweep asked for. The same bytes for any number of threads and processes. `progress` is called now and
/// then with the finished share (0 to 1) and returns false to stop; `kept` takes finished looks and gives them back to a later
/// solve of the same plan. With a `team` it computes looks beside the other processes of it, which help_to_solve() the same plan;
/// of the one that leads. Throws Interrupted when `progress` says stop.
SweepResult solve(const SolvePlan& plan, const std::function<bool(double)>& progress = {}, const KeptLooks& kept = {},
                  WorkTeam* team = nullptr);

/// The looks of a shard into the hands of `kept` alone: a later solve() that has those of all shards computes none. Otherwise as
/// solve().
void solve_shard(const SolvePlan& plan, const Shard& shard, const std::function<bool(double)>& progress, const KeptLooks& kept,
                 WorkTeam* team = nullptr);

/// Computes looks for the process that leads the team and solves the same plan. `progress` is called now and then, and returns
/// false to stop, as above.
void help_to_solve(const SolvePlan& plan, WorkTeam& team, const std::function<bool(double)>& progress = {});

/// Plans and solves. Throws InputError as SolvePlan does, Interrupted as above.
SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options = {});

}  // namespace raytube
