// A case from its target to its rows: plan, warnings, solve and what is recorded of it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "case/data/case.h"
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
  SolvePlan plan;
  std::vector<std::string> warnings;  // of the case and its plan

  /// `outermost`: points of the target as wide as all of it. Throws InputError for a case that cannot be solved, also for want of
  /// memory.
  PlannedCase(const Case& asked, const Target& target, const MeshReport& mesh_report, std::span<const dvec3> outermost,
              int threads, bool keep_parts);
};

/// Solves it, with a team beside others, and completes the manifest, except for times. Throws Interrupted once `progress` is
/// false.
SweepResult solve_case(const PlannedCase& planned, Manifest& manifest, const std::function<bool(double)>& progress,
                       const KeptLooks& kept, WorkTeam* team);

}  // namespace raytube
