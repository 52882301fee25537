// Far fields of many rectangular tubes at all frequencies, a few tubes at a time.
#pragma once

#include <array>
#include <vector>

#include "math/chebyshev.h"
#include "math/lanes.h"
#include "sbr/beams/footprint.h"

namespace raytube {

/// Collects tubes whose currents radiate together and adds up their far fields, always in the order in which they came.
class FarFields {
 public:
  explicit FarFields(std::span<const double> wavenumbers) : band_(wavenumbers) {}

  /// The part of a footprint over a launch rectangle of these sides about the launch point `center`: see phase_integral().
  void add(const Footprint& footprint, const dvec2& center, const dvec2& size);

  /// Adds S of all tubes collected to sums[frequency] and forgets the tubes. Of many frequencies a few are computed and the
  /// others interpolated to 1e-12 of what the tubes would give if they were all in phase.
  void add_up(std::vector<ScatteringMatrix>& sums);

 private:
  // A tube whose weights differ from frequency to frequency.
  struct Spectral {
    const Spectrum* spectrum;
    double phase, half_u, half_v, area;
  };
  struct Block {
    Reals phase, half_u, half_v;                      // exponent / k at the middle and from there to the sides [m]
    std::array<std::array<double, 4>, lanes> weight;  // VV, VH, HV, HH, times the area of the footprint
  };
  // Sum of weight * integral, phase reference at a path.
  struct Amplitudes {
    std::array<double, 4> re{}, im{};
  };

  Amplitudes at(double k, double path) const;
  void add_up_blocks(std::vector<ScatteringMatrix>& sums);
  void interpolate(const ChebyshevNodes& nodes, double path, std::vector<ScatteringMatrix>& sums);

  Band band_;
  std::vector<Block> blocks_;
  std::vector<Spectral> spectral_;
  std::vector<Amplitudes> samples_;
  std::size_t count_ = 0;
  double nearest_ = 0.0, farthest_ = 0.0;  // bounds of the exponents / k [m]
};

}  // namespace raytube
