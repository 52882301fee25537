// Integrals along strips of a surface.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "math/band_sum.h"
#include "scene/image.h"
#include "utd/wedge/path_place.h"

namespace raytube {

/// The steps of strips with S of one of the wavenumbers, each at its middle, or at the place of the path there.
struct StripPlaces {
  std::size_t wavenumber;  // index
  std::optional<PathPlace> by_path{};
  std::vector<ImageEdge> pieces{};
};

/// S of a look at one wavenumber [m], of how many points, pieces or ways it is the sum, and their work (utd/wedge/work.h).
struct CountedSum {
  ScatteringMatrix s{};
  std::uint64_t terms = 0;
  double work = 0.0;

  /// So many terms of the same work each.
  void count(std::uint64_t more, double each) { terms += more, work += each * static_cast<double>(more); }
};

/// Adds up amplitude e^{jk path} along strips, point after point; path and amplitude are linear between them (Filon's rule with
/// two points), but for the root of the strip's width in the amplitude, whose mean is that of a linear width. Keeps a reference
/// to `sum`.
class StripSum {
 public:
  /// Steps change paths by up to twice `half_span` [m]. `places` may be null; else `sum` takes every wavenumber.
  StripSum(BandSum& sum, double half_span, StripPlaces* places) : sum_(sum), half_span_(half_span), places_(places) {}

  /// The wavenumbers at which amplitudes are wanted.
  std::span<const double> wavenumbers() { return sum_.nodes(half_span_); }

  /// The next point of a strip, `step` [m] from the one before, with the amplitude [per metre] of each wavenumber; its first one
  /// if `first`. `width` is negative beyond a caustic.
  void add(bool first, double step, double path, const dvec3& position, double width,
           std::span<const ScatteringMatrix> amplitude);

 private:
  void add_step(double step, double path, const dvec3& middle, const std::array<double, 2>& shares,
                std::span<const ScatteringMatrix> amplitude);

  BandSum& sum_;
  const double half_span_;
  StripPlaces* places_;
  double path_ = 0.0, width_ = 0.0;  // those of the last point
  dvec3 position_{0.0}, start_{0.0};
  std::vector<ScatteringMatrix> amplitude_;
};

}  // namespace raytube
