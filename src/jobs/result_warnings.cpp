#include "jobs/result_warnings.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "jobs/inputs.h"
#include "jobs/material_report.h"
#include "output/words/summary.h"

namespace raytube {

std::vector<std::string> warnings_of_result(std::vector<std::string> sentences, const Case& c, const Target& target,
                                            const MeshReport& report, const Statistics& statistics) {
  std::ranges::copy(reading_sentences(c, report), std::back_inserter(sentences));
  for (const std::string& sentence : {duplicates_sentence(report), overlap_note(c, target).sentence})
    if (!sentence.empty()) sentences.push_back(sentence);
  for (const BeyondBound& part : statistics.beyond_bound) sentences.push_back(beyond_bound_sentence(part));
  if (statistics.lost_rays > 0) sentences.push_back(lost_rays_sentence(statistics, c.metres_per_unit, c.unit));
  return sentences;
}

void add_result(Manifest& manifest, const SweepResult& result, std::vector<std::string> warnings) {
  manifest.warnings = std::move(warnings);
  manifest.statistics = result.statistics;
  manifest.model_parts = result.model_parts;
  for (ModelPart& part : manifest.model_parts) part.rows.clear();
}

}  // namespace raytube
