// Bands of frequencies that lie where they do whatever a sweep has: what is decided or estimated once for a band is the same for
// a frequency alone and among others.
#pragma once

#include <cmath>

namespace raytube {

/// Of the middles of successive bands.
inline constexpr double band_ratio = 1.1;

/// The number of the band that a frequency [Hz] is in.
inline long band_of(double frequency) { return std::lround(std::log(frequency) / std::log(band_ratio)); }

/// The middle of a band [Hz].
inline double middle_of_band(long band) { return std::pow(band_ratio, static_cast<double>(band)); }

}  // namespace raytube
