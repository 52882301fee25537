// Cases in which bodies move: what of them one plan solves, and how the rest comes to it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "case/moving_target.h"
#include "core/work_team.h"
#include "scene/results.h"
#include "solve/solve.h"

namespace raytube {

/// Whether one plan solves every time: all of the target moves as one, and what it is seen from turns instead. That takes
/// antennas at infinity (those of edges.method = "utd" are none), no ground, and no turn of rough surfaces, of whose incoherent
/// power each polarisation alone is known; or a target that stands. Else each time has a target of its own.
bool is_one_plan(const Case& c, const MovingTarget& target);

/// What one plan solves, as a case without motion: all looks of all times as the body sees them, or those of the first time.
Case case_of_plan(const Case& c, const MovingTarget& target);

/// The same of the times that are traced (jobs/retrace.h); of a case that stands, without `target`, that case.
Case case_of_plan(const Case& c, const MovingTarget* target);

/// The target of that case. Throws InputError.
LoadedMesh mesh_of_plan(const Case& c, const MovingTarget& target);

struct LoadedCaseTarget {
  std::shared_ptr<const MovingTarget> moving;  // null: everything stands
  LoadedMesh loaded;                           // of the plan
};
/// Reads the mesh files of any case. Throws InputError.
LoadedCaseTarget load_target_of_plan(const Case& c);

/// The case at one of its times, by number, without motion.
Case case_of_pulse(const Case& c, std::size_t pulse);

/// Sentences about a case and what its plan is of, before it is solved; `target` is null if it stands, `outermost` are points of
/// it as wide as all of it. Throws InputError, with the time, if a body moves to where an antenna has not all of the target in
/// front.
std::vector<std::string> warnings_before(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost,
                                         const MovingTarget* target);

/// Rows that one plan has found, as the antennas see them: polarisation and phase of a body that has turned and shifted.
void refer_to_antennas(const Case& c, const MovingTarget& target, SweepResult& result);

/// Every time by itself, as solve() with `threads` for all of them; their number stands in the place of that of a look.
SweepResult solve_pulses(const Case& c, const MovingTarget& target, int threads, bool keep_parts,
                         const std::function<bool(double)>& progress, const KeptLooks& kept, WorkTeam* team);
/// As solve_shard().
void solve_shard_of_pulses(const Case& c, const MovingTarget& target, const Shard& shard, int threads,
                           const std::function<bool(double)>& progress, const KeptLooks& kept, WorkTeam* team);
/// As help_to_solve().
void help_to_solve_pulses(const Case& c, const MovingTarget& target, int threads, WorkTeam& team,
                          const std::function<bool(double)>& progress);

}  // namespace raytube
