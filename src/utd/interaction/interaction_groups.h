// Which edges and faces are large enough for edge-face interaction, at each frequency.
#pragma once

#include <vector>

#include "utd/interaction/edge_axes.h"

namespace raytube {

/// Frequencies at which the same edges and faces count.
struct InteractionGroup {
  std::vector<std::size_t> indices;  // in the list of frequencies
  std::vector<double> frequencies;   // [Hz]
  std::vector<EdgeAxis> axes;        // of a wavelength or more; they point into the wedges
  std::vector<dvec3> corners;        // of the target; none if there are more than 200
  std::vector<bool> large;  // the patches of at least a wavelength squared: others stand in the way, but neither receive waves
                            // nor reflect them
};

/// Whether at each of these frequencies [Hz] more than 1024 pairs of an edge and a patch are large enough: bodies of so many
/// parts do without edge-face interaction.
std::vector<bool> interaction_limit_exceeded(const TriangleMesh& mesh, std::span<const Wedge> wedges,
                                             std::span<const double> frequencies);

/// The groups of the `wanted` ones among the frequencies [Hz], without those at which there is nothing to illuminate.
std::vector<InteractionGroup> interaction_groups(const TriangleMesh& mesh, std::span<const Wedge> wedges,
                                                 std::span<const double> frequencies, const std::vector<bool>& wanted);

}  // namespace raytube
