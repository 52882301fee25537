#include "jobs/warnings/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "case/materials/materials.h"
#include "core/text.h"
#include "jobs/warnings/idle_keys.h"
#include "mesh/features/feature_sizes.h"
#include "mesh/soundness/open_bodies.h"
#include "mesh/soundness/thick_layers.h"
#include "output/words/warnings.h"
#include "scene/sampling.h"

namespace raytube {

namespace {

SmallFeatures smaller_than(const std::vector<SizedArea>& features, double size, double whole) {
  SmallFeatures small;
  for (const SizedArea& feature : features) {
    if (feature.size >= size) continue;
    ++small.count;
    small.share += feature.area / whole;
  }
  return small;
}

}  // namespace

Validity validity_of(const Target& target, const Sweep& sweep, std::span<const dvec3> outermost) {
  const double frequency = std::ranges::min(sweep.frequencies), longest = wavelength(frequency);
  const FeatureSizes sizes = feature_sizes(target.mesh, target.options.min_wedge_angle);
  Validity validity{frequency, largest_extent(outermost), {}, {}, {}};
  if (sizes.components.size() > 1) validity.parts = smaller_than(sizes.components, longest, sizes.area);
  validity.faces = smaller_than(sizes.faces, longest, sizes.area);
  validity.radii = smaller_than(sizes.radii, longest, sizes.area);
  return validity;
}

std::vector<std::string> warnings_of(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost) {
  const MeshUnit unit{c.metres_per_unit, c.unit};
  const Target& target = plan.target;
  std::vector<std::string> sentences = c.warnings;
  for (const std::string& name : unused_materials(c))
    sentences.push_back(fmt::format(
        "materials.{0}: nothing is made of it, so it has no effect; write target.material = \"{0}\" or target.parts, or "
        "remove it",
        quotable(name)));
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
