// Bands of frequencies that lie where they do whatever a sweep has: what is decided, sampled or estimated once for a band is the
// same for a frequency alone and among others.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/angle.h"
#include "core/field.h"

namespace raytube {

/// Ratio of the middles of successive bands in which estimates are made: 24 in a decade.
inline constexpr double band_ratio = 1.1006941712522096;

/// The number of the band of estimates that a frequency [Hz] is in.
inline long band_of(double frequency) { return std::lround(std::log(frequency) / std::log(band_ratio)); }

/// The middle of a band [Hz].
inline double middle_of_band(long band) { return std::pow(band_ratio, static_cast<double>(band)); }

/// A fifth of a decade [Hz], of those that end at 12.02 GHz, 19.05 GHz and so on: frequencies in it are solved together, and what
/// samples them is as fine as its middle asks, or its top, where a sum is no better than its points. Targets ten times as large
/// at a tenth of the frequency are sampled alike, and the bands of common radars (8 to 12, 12.4 to 18, 24, 57 to 64, 76 to 81, 92
/// to 96 GHz) are not divided.
struct SampledBand {
  double lowest, middle, highest;
};

/// The one that a frequency [Hz] is in. Products alone: the same on every system.
inline SampledBand sampled_band(double frequency) {
  constexpr double highest = 1.202264434617413, middle_of_highest = 0.954992586021436,
                   ratio = 1.584893192461113;  // 10^0.08, 10^-0.02, 10^0.2
  double decade = 1.0;
  while (highest * decade <= frequency) decade *= 10.0;
  while (highest * decade > 10.0 * frequency) decade *= 0.1;
  double below = 1.0;
  while (highest * decade / (below * ratio) > frequency) below *= ratio;
  return {highest * decade / (below * ratio), middle_of_highest * decade / below, highest * decade / below};
}

/// The frequency [Hz] for which samples are to be fine enough that serve all of these: no function of them but of the band
/// that the highest is in.
inline double sampling_frequency(std::span<const double> frequencies) {
  return sampled_band(std::ranges::max(frequencies)).middle;
}

/// Frequencies [Hz] that none of these is below, or above: the same for all of a sampled band.
inline double least_frequency(std::span<const double> frequencies) { return sampled_band(std::ranges::min(frequencies)).lowest; }
inline double greatest_frequency(std::span<const double> frequencies) {
  return sampled_band(std::ranges::max(frequencies)).highest;
}

/// The sampling wavenumber of wavenumbers [rad/m].
inline double sampling_wavenumber(std::span<const double> wavenumbers) {
  return wavenumber(sampled_band(std::ranges::max(wavenumbers) * speed_of_light / (2.0 * pi)).middle);
}
inline double greatest_wavenumber(std::span<const double> wavenumbers) {
  return wavenumber(sampled_band(std::ranges::max(wavenumbers) * speed_of_light / (2.0 * pi)).highest);
}
inline double least_wavenumber(std::span<const double> wavenumbers) {
  return wavenumber(sampled_band(std::ranges::min(wavenumbers) * speed_of_light / (2.0 * pi)).lowest);
}

}  // namespace raytube
