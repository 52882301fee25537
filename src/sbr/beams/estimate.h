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

/// The excess() of these errors [m] of a row with this sum. Of a monostatic one both cross-polar channels are their mean.
double excess(ScatteringMatrix total, ChannelErrors errors, bool monostatic, double relative_tolerance,
              const ChannelErrors& permitted);

}  // namespace raytube
