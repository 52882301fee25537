// What a tolerance, given in decibels, permits of a row.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/field.h"

namespace raytube {

/// Error of an amplitude, as a share of it, that moves its level by `tolerance_db` [dB]: |S + error| / |S| = 10^(dB / 20).
inline double relative_tolerance(double tolerance_db) { return std::pow(10.0, tolerance_db / 20.0) - 1.0; }

/// A channel whose amplitude is below this share of the strongest one's in its row, 20 dB under it, is held to what the tolerance
/// is at that share: decibels of what hardly returns are dear.
inline constexpr double low_channel = 0.1;

/// How many times the errors [m] of a row exceed what it may have in each channel, at worst: what the tolerance permits, or
/// `permitted` [m] if that is more.
inline double excess(const ScatteringMatrix& s, const ChannelErrors& errors, double relative_tolerance,
                     const ChannelErrors& permitted = {}) {
  double worst = 0.0;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) {
      const double amplitude = std::max(std::abs(s.at(p, q)), low_channel * largest_amplitude(s));
      if (amplitude > 0.0) worst = std::max(worst, errors[p][q] / std::max(relative_tolerance * amplitude, permitted[p][q]));
    }
  return worst;
}

}  // namespace raytube
