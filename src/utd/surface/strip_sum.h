// Integrals along strips of a surface.
#pragma once

#include <span>
#include <vector>

#include "scene/image.h"

namespace raytube {

/// The steps of strips with S of one of the wavenumbers, each at its middle.
struct StripPlaces {
  std::size_t wavenumber;  // index
  std::vector<ImageEdge> pieces{};
};

/// Adds up amplitude e^{jk path} along strips, point after point; amplitude and path are linear between them (Filon's rule with
/// two points). Keeps references to its arguments.
class StripSum {
 public:
  /// S of every wavenumber is added to `sum`; `places` may be null.
  StripSum(std::span<const double> wavenumbers, std::span<ScatteringMatrix> sum, StripPlaces* places);

  /// The next point of a strip, `step` [m] from the one before, with the amplitude [per metre] of each wavenumber; its first one
  /// if `first`.
  void add(bool first, double step, double path, const dvec3& position, std::span<const ScatteringMatrix> amplitude);

 private:
  ScatteringMatrix over_step(std::size_t index, double step, double path, const ScatteringMatrix& amplitude) const;

  std::span<const double> wavenumbers_;
  std::span<ScatteringMatrix> sum_;
  StripPlaces* places_;
  double path_ = 0.0;  // of the last point
  dvec3 position_{0.0};
  std::vector<ScatteringMatrix> amplitude_;
};

}  // namespace raytube
