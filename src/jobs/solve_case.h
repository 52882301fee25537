// A case from its target to its rows: plan, warnings, solve and what is recorded of it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "jobs/moving.h"
#include "jobs/retrace.h"
#include "mesh/model/triangle_mesh.h"
#include "output/files/manifest.h"
#include "plan/plan.h"
#include "scene/results.h"
#include "solve/solve.h"

namespace raytube {

/// Refers to the case, the target and the report.
struct PlannedCase {
  const Case& c;
  const MeshReport& report;
  std::shared_ptr<const MovingTarget> moving;  // null: everything stands
  std::vector<TracedInterval> intervals;       // of one with motion.retrace = "auto"; else none
  std::unique_ptr<const Case> traced;          // of that: the case at the times that are traced; else null
  std::unique_ptr<const Case> part;            // of one that moves: what `plan` is of (jobs/moving.h); else null
  SolvePlan plan;
  std::vector<std::string> warnings;  // of the case and its plan

  /// `outermost`: points of the target as wide as all of it. Of a case that moves `target` is that of mesh_of_plan. Throws
  /// InputError for a case that cannot be solved, also for want of memory.
  PlannedCase(const Case& asked, const Target& target, const MeshReport& mesh_report, std::span<const dvec3> outermost,
              int threads, bool keep_parts, std::shared_ptr<const MovingTarget> moving_target = {});

  /// What is computed, all of it or at some of its times.
  const Case& computed() const { return traced ? *traced : c; }
  /// Each time is solved by itself.
  bool pulse_by_pulse() const { return moving && !is_one_plan(c, *moving); }
  /// What is computed, kept and shared one by one: looks, or times.
  std::size_t items() const { return pulse_by_pulse() ? computed().times() : plan.looks.computed.size(); }
};

/// Solves it, with a team beside others, and completes the manifest, except for times. Throws Interrupted once `progress` is
/// false.
SweepResult solve_case(const PlannedCase& planned, Manifest& manifest, const std::function<bool(double)>& progress,
                       const KeptLooks& kept, WorkTeam* team);

/// The items of a shard into the hands of `kept` alone, as solve_shard().
void solve_shard_of_case(const PlannedCase& planned, const Shard& shard, const std::function<bool(double)>& progress,
                         const KeptLooks& kept, WorkTeam* team);

/// Computes items for the process that leads the team and solves the same case. `target` as above.
void help_to_solve_case(const Case& c, const Target& target, int threads, bool keep_parts, WorkTeam& team,
                        const std::function<bool(double)>& progress = {}, const std::shared_ptr<const MovingTarget>& moving = {});

}  // namespace raytube
