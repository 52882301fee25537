#include "jobs/solve_case.h"

#include "jobs/memory.h"
#include "jobs/result_warnings.h"
#include "jobs/solvable.h"
#include "jobs/warnings/warnings.h"

namespace raytube {

PlannedCase::PlannedCase(const Case& asked, const Target& target, const MeshReport& mesh_report, std::span<const dvec3> outermost,
                         int threads, bool keep_parts)
    : c(asked), report(mesh_report), plan(plan_of_case(target, c, threads, keep_parts)) {
  check_memory(plan, c);
  warnings = warnings_of(c, plan, outermost);
}

SweepResult solve_case(const PlannedCase& planned, Manifest& manifest, const std::function<bool(double)>& progress,
                       const KeptLooks& kept, WorkTeam* team) {
  SweepResult result = solve(planned.plan, progress, kept, team);
  add_result(manifest, result,
             warnings_of_result(planned.warnings, planned.c, planned.plan.target, planned.report, result.statistics));
  return result;
}

}  // namespace raytube
