#include "jobs/solve_case.h"

#include "jobs/memory.h"
#include "jobs/result_warnings.h"
#include "jobs/solvable.h"
#include "jobs/warnings/warnings.h"
#include "solve/random.h"

namespace raytube {

PlannedCase::PlannedCase(const Case& asked, const Target& target, const MeshReport& mesh_report, std::span<const dvec3> outermost,
                         int threads, bool keep_parts, const std::optional<RandomOptions>& random_tubes)
    : c(asked), report(mesh_report), random(random_tubes), plan(plan_of_case(target, c, threads, keep_parts || random)) {
  check_memory(plan, c, random ? &*random : nullptr);
  if (random) check_random_tubes(plan, *random);
  warnings = warnings_of(c, plan, outermost);
}

SolvedCase solve_case(const PlannedCase& planned, Manifest& manifest, const std::function<bool(double)>& progress,
                      const KeptLooks& kept, WorkTeam* team) {
  const SolvePlan& plan = planned.plan;
  SolvedCase solved;
  if (planned.random) {
    solved.by_chance = solve_with_random_tubes(plan, *planned.random, progress, team);
    const RandomResult& random = *solved.by_chance;
    solved.result = random.mean;
    manifest.random = {random.options, random.run_s, random.deterministic.statistics.solve_s};
  } else {
    solved.result = solve(plan, progress, kept, team);
  }
  add_result(manifest, solved.result,
             warnings_of_result(planned.warnings, planned.c, plan.target, planned.report, solved.result.statistics));
  return solved;
}

}  // namespace raytube
