// Integrals over the azimuth about an edge, of everything an observer sees at all frequencies.
#pragma once

#include <functional>
#include <vector>

#include "field.h"

namespace raytube {

/// Sets the integrand at an azimuth, per frequency.
using AzimuthDensity = std::function<void(double azimuth, std::vector<ScatteringMatrix>& density)>;

struct AzimuthIntegral {
  std::vector<ScatteringMatrix> value;  // per frequency
  std::vector<ChannelErrors> error;     // estimated, per frequency
};

/// Integral over panels between ascending `cuts`. Gauss rules of more and more points, then half the panel, until the estimated
/// error is below the panel's share of `tolerance`. `turns` is the phase [rad] the integrand may turn by per radian: a first
/// guess.
AzimuthIntegral integrate_over_azimuth(const AzimuthDensity& density, std::size_t frequencies, const std::vector<double>& cuts,
                                       double turns, double tolerance);

}  // namespace raytube
