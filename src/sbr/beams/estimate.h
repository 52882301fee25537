// How far the sums of a look may be from those of endlessly many tubes.
#pragma once

#include <span>
#include <vector>

#include "sbr/beams/tube_sums.h"
#include "sbr/launch/launch.h"

namespace raytube {

/// Estimated numerical error of |S_pq|, [frequency], of what the tubes of a look add up to. The geometry counts as exact.
std::vector<ChannelErrors> numerical_error(const TubeSums& sums, const LaunchGrid& grid, std::span<const double> wavenumbers,
                                           double radius);

/// Adds to the error of a whole look what tubes that were cut may still have brought.
void add_truncated_tubes(TubeSums& sums);

/// The share of max(|S_pq|, S_max / 100) that a level [dB] stands for, S_max the largest of the four amplitudes.
double relative_error(double level_db);

/// How many times the estimate exceeds this share, at worst over frequencies and channels.
double excess(const TubeSums& sums, const std::vector<ChannelErrors>& errors, double share);

}  // namespace raytube
