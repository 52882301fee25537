#include "program/solve_warnings.h"

#include <fmt/format.h>

#include "case/target.h"
#include "jobs/inputs.h"
#include "jobs/material_report.h"
#include "output/words/summary.h"
#include "program/work/results.h"

namespace raytube {

namespace {

void warn_of_mesh(const Case& c, const std::string& sentence) {
  if (!sentence.empty()) warn(fmt::format("{}: {}", mesh_names(c), sentence));
}

}  // namespace

void warn_of_reading(const Case& c, const MeshReport& report) {
  for (const std::string& sentence : reading_sentences(c, report)) warn_of_mesh(c, sentence);
}

void warn_of_materials(const Case& c, const MeshReport& report, const Target& target, Manifest& manifest) {
  const OverlapNote overlap = overlap_note(c, target);
  for (const std::string& sentence : {duplicates_sentence(report), overlap.sentence}) warn_of_mesh(c, sentence);
  if (overlap.pairs > 0)
    manifest.mesh_notes.emplace_back("pairs of facets of different materials upon one another in one plane, one of which is seen",
                                     static_cast<double>(overlap.pairs));
}

void warn_of_lost_rays(const Case& c, const Statistics& statistics) {
  if (statistics.lost_rays > 0) warn(lost_rays_sentence(statistics, c.metres_per_unit, c.unit));
}

bool warn_of_unusable_rows(const Statistics& statistics) {
  for (const BeyondBound& part : statistics.beyond_bound) warn(beyond_bound_sentence(part));
  return !statistics.beyond_bound.empty();
}

UnusableRows unusable_rows_in(const std::filesystem::path& folder) {
  return UnusableRows(
      fmt::format("{}: the results are written, but hold rows that must not be used, as reported above", folder.string()));
}

}  // namespace raytube
