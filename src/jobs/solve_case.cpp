#include "jobs/solve_case.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "jobs/inputs.h"
#include "jobs/material_report.h"
#include "jobs/memory.h"
#include "jobs/solvable.h"
#include "jobs/warnings/warnings.h"
#include "output/words/summary.h"

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
  if (statistics.lost_rays > 0) sentences.push_back(lost_rays_sentence(statistics, c.metres_per_unit, c.unit));
  return sentences;
}

}  // namespace

PlannedCase::PlannedCase(const Case& asked, const Target& target, const MeshReport& mesh_report, std::span<const dvec3> outermost,
                         int threads, bool keep_parts)
    : c(asked), report(mesh_report), plan(plan_of_case(target, c, threads, keep_parts)) {
  check_memory(plan, c);
  warnings = warnings_of(c, plan, outermost);
}

SweepResult solve_case(const PlannedCase& planned, Manifest& manifest, const std::function<bool(double)>& progress,
                       const KeptLooks& kept, WorkTeam* team) {
  SweepResult result = solve(planned.plan, progress, kept, team);
  manifest.warnings = warnings_of_result(planned, result.statistics);
  manifest.statistics = result.statistics;
  manifest.model_parts = result.model_parts;
  for (ModelPart& part : manifest.model_parts) part.rows.clear();
  return result;
}

}  // namespace raytube
