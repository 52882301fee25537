// Which looks of a sweep are computed, and from which of them the others follow.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scene/sweep.h"

namespace raytube {

/// The computed look that a look is equal to: equal directions, or those of its mirror image in symmetry planes of the target.
struct LookSource {
  std::size_t index;      // in LookPlan::computed
  bool mirrored = false;  // in an odd number of planes: cross-polar amplitudes change sign
};

/// Which looks are computed, and which follow from these.
struct LookPlan {
  std::vector<std::size_t> computed;  // looks, in the order of the sweep
  std::vector<LookSource> sources;    // of every look of the sweep
  std::uint64_t repeated = 0;         // looks equal to an earlier one, phi counted modulo a turn
  std::uint64_t mirrored = 0;         // looks that are the mirror image of an earlier one
};

/// The plan of so many looks of which every one is computed.
LookPlan plan_all(std::size_t looks);

/// Each look is computed once, and only one of those that the target's symmetry planes (x = 0, y = 0, z = 0 through its middle)
/// carry into one another. With M the reflection and S referred to the middle, the field of the image is the image of the field:
/// for x and y theta_hat' = M theta_hat and phi_hat' = -M phi_hat, for z both signs are opposite. So S_vv and S_hh stay, S_vh and
/// S_hv change sign. Directions agree to rounding: a few 1e-15 rad.
LookPlan plan_looks(std::span<const Look> looks, const std::array<bool, 3>& symmetry_planes);

/// The amplitudes of a look from those of its source.
ScatteringMatrix from_source(ScatteringMatrix s, const LookSource& source);

}  // namespace raytube
