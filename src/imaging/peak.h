// The highest level between the samples of a grid.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "core/field.h"

namespace raytube {

struct GridPeak {
  std::size_t sample = 0;  // the one it is next to
  dvec3 offset{0.0};       // from that sample, along the grid's axes [m]
  double amplitude = 0.0;  // of the channel that is largest there [m]
};

/// |S| of one channel (V, H received; V, H transmitted) at an offset from a sample.
using AmplitudeNear = std::function<double(std::size_t sample, int channel, const dvec3& offset)>;

/// Climbs from the highest samples of a band-limited sum to its highest peak. `steps`: along the grid's axes, the last one
/// running fastest [m]; 0 along one over which the sum is not continuous, such as looks. `density`: samples to a resolution cell
/// of even weights.
GridPeak highest_peak(std::span<const ScatteringMatrix> samples, const std::array<std::size_t, 3>& shape, const dvec3& steps,
                      double density, const AmplitudeNear& amplitude);

}  // namespace raytube
