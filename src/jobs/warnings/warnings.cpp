#include "jobs/warnings/warnings.h"

#include <algorithm>

#include "jobs/warnings/idle_keys.h"
#include "mesh/soundness/open_bodies.h"
#include "mesh/soundness/thick_layers.h"
#include "output/words/warnings.h"
#include "solve/validity.h"

namespace raytube {

std::vector<std::string> warnings_of(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost) {
  const MeshUnit unit{c.metres_per_unit, c.unit};
  const Target& target = plan.target;
  std::vector<std::string> sentences = c.warnings;
  std::ranges::copy(open_body_warnings(find_open_bodies(target.mesh, target.components_enclosed, plan.sweep.materials), unit),
                    std::back_inserter(sentences));
  std::ranges::copy(thick_layer_warnings(find_thick_layers(target.mesh, plan.sweep.materials), plan.sweep.materials, unit),
                    std::back_inserter(sentences));
  std::ranges::copy(validity_warnings(validity_of(target, plan.sweep, outermost), unit), std::back_inserter(sentences));
  std::ranges::copy(sampling_warnings(coarse_steps(c.sweep, outermost)), std::back_inserter(sentences));
  std::ranges::copy(idle_key_warnings(c, plan), std::back_inserter(sentences));
  return sentences;
}

}  // namespace raytube
