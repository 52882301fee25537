// Which edges and surfaces are large enough for waves between them, at each frequency.
#pragma once

#include <vector>

#include "utd/interaction/edge_axes.h"

namespace raytube {

/// Frequencies at which the same edges and surfaces count.
struct InteractionGroup {
  std::vector<std::size_t> places;  // in the list of frequencies
  std::vector<double> frequencies;
  std::vector<EdgeAxis> axes;  // of a wavelength or more; they point into the wedges
  std::vector<dvec3> corners;  // of the target; none if there are more than 200
  std::vector<bool> large;     // the patches of at least a wavelength squared: others stand in the way, but are neither painted
                               // nor mirrors
};

/// Whether at each of these frequencies more than 1024 pairs of an edge and a patch would have to be looked at: bodies of so many
/// parts do without.
std::vector<bool> interaction_limit_exceeded(const TriangleMesh& mesh, std::span<const Wedge> wedges,
                                             std::span<const double> frequencies);

/// The groups of the frequencies that are not `crowded`, without those at which there is nothing to light.
std::vector<InteractionGroup> interaction_groups(const TriangleMesh& mesh, std::span<const Wedge> wedges,
                                                 std::span<const double> frequencies, const std::vector<bool>& above_limit);

}  // namespace raytube
