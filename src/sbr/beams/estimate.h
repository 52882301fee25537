// How far the sums of a look may be from the limit of ever more tubes.
#pragma once

#include <span>
#include <vector>

#include "sbr/beams/tube_sums.h"
#include "sbr/launch/launch.h"

namespace raytube {

/// Estimated numerical error of |S_pq| [m], [frequency], of what the tubes of a look on `grid` add up to; `radius` is that of the
/// mesh [m]. The geometry counts as exact.
std::vector<ChannelErrors> numerical_error(const TubeSums& sums, const LaunchGrid& grid, std::span<const double> wavenumbers,
                                           double radius);

/// Adds to the error of a whole look what its truncated tubes may still have brought: an extrapolation, right in the order of
/// magnitude.
void add_truncated_tubes(TubeSums& sums);

/// What the errors of a look may be.
struct PermittedErrors {
  double relative_tolerance;               // of every channel: scene/tolerance.h
  std::vector<ChannelErrors> in_any_case;  // [frequency] [m]; empty: none
};

/// The excess() of a look at its worst frequency. Of a monostatic one both cross-polar channels are their mean.
double excess(const TubeSums& sums, std::vector<ChannelErrors> errors, const PermittedErrors& permitted, bool monostatic);

}  // namespace raytube
