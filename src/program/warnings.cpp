#include "program/warnings.h"

#include <algorithm>

#include "output/words/warnings.h"
#include "solve/validity.h"

namespace raytube {

std::vector<std::string> warnings_of(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost) {
  std::vector<std::string> sentences = c.warnings;
  std::ranges::copy(validity_warnings(validity_of(plan.target, plan.sweep, outermost)), std::back_inserter(sentences));
  std::ranges::copy(sampling_warnings(coarse_steps(plan.sweep, outermost)), std::back_inserter(sentences));
  return sentences;
}

}  // namespace raytube
