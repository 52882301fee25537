#include "solve/validity.h"

#include <algorithm>

#include "mesh/features/feature_sizes.h"
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

}  // namespace raytube
