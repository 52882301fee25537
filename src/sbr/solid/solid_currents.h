// What tubes radiate outside of solids.
#pragma once

#include <algorithm>

#include "sbr/beams/tube_sums.h"
#include "sbr/solid/solid_ray.h"
#include "sbr/solid/tube_piece.h"
#include "scene/frequency_bands.h"

namespace raytube {

/// The frequencies [begin, end) of a look at which all materials are the same.
struct FrequencyGroup {
  std::size_t begin, end;
};

/// Those of a look, in order.
std::vector<FrequencyGroup> frequency_groups(const SpectralSurfaces& surfaces);

/// Adds up the fields of tubes as currents on surfaces, at some frequencies.
class SolidCurrents {
 public:
  using Rays = std::array<SolidRay, 3>;
  using Hits = std::array<SolidHit, 3>;

  /// Keeps references.
  SolidCurrents(const TubeLook& look, const SolidWaves& waves, const FrequencyGroup& frequencies, TubeSums& sums)
      : look_(look),
        waves_(waves),
        frequencies_(frequencies),
        lowest_(least_wavenumber(look.wavenumbers().subspan(frequencies.begin, frequencies.end - frequencies.begin))),
        sums_(sums) {}

  /// The triangle that tubes meet first from now on.
  void begin(std::uint32_t triangle) { triangle_ = triangle; }

  /// What leaves a solid, as currents on its outside (Love's principle, scene/material.h).
  void add_leaving(const TubePiece& piece, const Rays& rays, const Hits& hits, const Complex& spreading, int bounce);
  /// Adds the currents of the wave that meets a surface from outside, and of what that reflects.
  void add_meeting(const TubePiece& piece, const Hits& hits, const Complex& spreading, int bounce);

 private:
  /// `left`: the power that leaves solids here [m^2].
  void add(const TubePiece& piece, const Hits& hits, const std::array<ChannelWeights, 3>& weights, const Complex& spreading,
           int bounce, double left);
  Complex mean(const TubePiece& piece, const Hits& hits, double wavenumber) const;
  void count_error(const TubePiece& piece, std::size_t f, const ScatteringMatrix& s);

  const TubeLook& look_;
  const SolidWaves& waves_;
  FrequencyGroup frequencies_;
  double lowest_;  // wavenumber
  TubeSums& sums_;
  std::uint32_t triangle_ = no_index;
};

}  // namespace raytube
