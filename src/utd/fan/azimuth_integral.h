// Integrals over the azimuth about an edge, at all frequencies.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Phases that the integrand has at an azimuth, at the highest wavenumber.
struct PhaseRange {
  double low, high;  // [rad]
};

/// [rad]
struct AzimuthRange {
  double from, to;
};

/// An integrand: S per radian of azimuth, at all frequencies.
struct AzimuthDensity {
  std::function<void(double azimuth, std::vector<ScatteringMatrix>& density)> at;  // sets `density`
  std::function<std::optional<PhaseRange>(double azimuth)> survey;                 // none where it vanishes
  std::function<void(double azimuth, double weight)> counted{};  // told of every point of the sum that is returned; may be none
};

struct AzimuthIntegral {
  std::vector<ScatteringMatrix> value;  // per frequency
  std::vector<ChannelErrors> error;     // estimated, per frequency
};

/// Integral over panels between ascending `cuts` [rad]. A Gauss rule of as many points as the phases of the integrand ask for,
/// then of more, then half the panel, at once where they ask for more than 48, until the estimated error is below the panel's
/// share of `tolerance`. A panel with nothing at its middle and close to its ends is passed over. `tolerance` is that of the
/// Frobenius norm of the sum. Of the panels none is left out but those that `wanted` [rad], if not empty, does not reach.
AzimuthIntegral integrate_over_azimuth(const AzimuthDensity& density, std::size_t frequency_count,
                                       const std::vector<double>& cuts, double tolerance,
                                       std::span<const AzimuthRange> wanted = {});

}  // namespace raytube
