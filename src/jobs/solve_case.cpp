#include "jobs/solve_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "jobs/inputs.h"
#include "jobs/material_report.h"
#include "jobs/memory.h"
#include "jobs/solvable.h"
#include "output/words/summary.h"
#include "scene/tolerance.h"

namespace raytube {

namespace {

// What is said of the case, then of the mesh and of the rows that came out: all that a result carries. No file is named.
std::vector<std::string> warnings_of_result(const PlannedCase& planned, const Statistics& statistics) {
  const Case& c = planned.c;
  std::vector<std::string> sentences = planned.warnings;
  std::ranges::copy(reading_sentences(c, planned.report), std::back_inserter(sentences));
  for (const std::string& sentence : {duplicates_sentence(planned.report), overlap_note(c, planned.plan.target).sentence})
    if (!sentence.empty()) sentences.push_back(sentence);
  for (const BeyondBound& part : statistics.beyond_bound) sentences.push_back(beyond_bound_sentence(part));
  for (const Skipped& skipped : statistics.skipped)
    if (skipped.what == times_between && skipped.figure > relative_tolerance(c.tubes.tolerance_db))
      sentences.push_back(
          fmt::format("S between traced times is off by up to {:.2g} of S where it was checked; write motion.retrace = "
                      "\"every\", or take err_*_db into account",
                      skipped.figure));
  if (statistics.lost_rays > 0) sentences.push_back(lost_rays_sentence(statistics, c.metres_per_unit, c.unit));
  return sentences;
}

}  // namespace

PlannedCase::PlannedCase(const Case& asked, const Target& target, const MeshReport& mesh_report, std::span<const dvec3> outermost,
                         int threads, bool keep_parts, std::shared_ptr<const MovingTarget> moving_target)
    : c(asked),
      report(mesh_report),
      moving(std::move(moving_target)),
      intervals(moving && !c.motion->retrace ? traced_intervals(c, *moving) : std::vector<TracedInterval>()),
      traced(intervals.empty() ? nullptr : std::make_unique<const Case>(traced_case(c, intervals))),
      part(moving ? std::make_unique<const Case>(case_of_plan(computed(), *moving)) : nullptr),
      plan(plan_of_case(target, part ? *part : c, threads, keep_parts)) {
  check_memory(plan, c);
  warnings = warnings_before(c, plan, outermost, moving.get());
}

SweepResult solve_case(const PlannedCase& planned, Manifest& manifest, const std::function<bool(double)>& progress,
                       const KeptLooks& kept, WorkTeam* team) {
  const SolvePlan& plan = planned.plan;
  SweepResult result = planned.pulse_by_pulse() ? solve_pulses(planned.computed(), *planned.moving, plan.threads, plan.tell_parts,
                                                               progress, kept, team)
                                                : solve(plan, progress, kept, team);
  if (planned.moving && !planned.pulse_by_pulse()) refer_to_antennas(planned.computed(), *planned.moving, result);
  if (planned.traced) result = with_all_times(planned.c, *planned.moving, planned.intervals, std::move(result));
  manifest.warnings = warnings_of_result(planned, result.statistics);
  manifest.statistics = result.statistics;
  manifest.model_parts = result.model_parts;
  for (ModelPart& part : manifest.model_parts) part.rows.clear();
  return result;
}

void solve_shard_of_case(const PlannedCase& planned, const Shard& shard, const std::function<bool(double)>& progress,
                         const KeptLooks& kept, WorkTeam* team) {
  if (planned.pulse_by_pulse())
    solve_shard_of_pulses(planned.computed(), *planned.moving, shard, planned.plan.threads, progress, kept, team);
  else
    solve_shard(planned.plan, shard, progress, kept, team);
}

void help_to_solve_case(const Case& c, const Target& target, int threads, bool keep_parts, WorkTeam& team,
                        const std::function<bool(double)>& progress, const std::shared_ptr<const MovingTarget>& moving) {
  if (moving && !is_one_plan(c, *moving))
    return help_to_solve_pulses(computed_case(c, *moving), *moving, threads, team, progress);
  const Case part = case_of_plan(c, moving.get());
  help_to_solve(plan_of_case(target, part, threads, keep_parts), team, progress);
}

}  // namespace raytube
