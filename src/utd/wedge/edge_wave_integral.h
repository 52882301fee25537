// Integrals of an edge's waves over a row of parallel rays where these meet a plane. Derived in docs/theory/interaction.md.
#pragma once

#include <vector>

#include "utd/wedge/row_waves.h"

namespace raytube {

/// Rays of one azimuth that meet one plane, by the arc length z at which they leave the edge, from <= z <= to [m].
struct RayRow {
  double from = 0.0, to = 0.0;
  double path = 0.0, path_rate = 0.0;    // the ray from z is path + path_rate z long, from the edge on [m]
  double phase = 0.0, phase_rate = 0.0;  // exponent / k there
};

/// Sums of waves u e^{-jk s}, s the length of a ray and rho = s sin(beta0): the integrals over z of s e^{jk phase} times
/// u, and times rho du/d(rho) / sin(beta0) and du/d(azimuth) / sin(beta0), the slopes that a ray does without.
struct WaveSums {
  Complex value, outwards, around;

  WaveSums& operator+=(const WaveSums& other) { return *this = *this + other; }
  friend WaveSums operator+(const WaveSums& a, const WaveSums& b) {
    return {a.value + b.value, a.outwards + b.outwards, a.around + b.around};
  }
  friend WaveSums operator-(const WaveSums& a, const WaveSums& b) {
    return {a.value - b.value, a.outwards - b.outwards, a.around - b.around};
  }
};

struct WaveIntegrals {
  WaveSums incident, reflected;
};

/// The waves of one azimuth from the piece [from, to] of an edge.
///
/// Where the start of a ray passes an end of the piece its wave neither stops nor goes on: Fresnel's step of the detour over the
/// end, 1 - D inside and D outside with D = e^{-jx^2} W(x) / 2, x^2 = k detour. It is divided between the two edges that meet
/// there: z^2 / (z^2 + x^2) of it is this one's, z^2 the argument X of the wave's own transition. `corners` are the arc
/// lengths of these ends, infinite where there is none; rays between `from` and `to` count whole.
class EdgeWaveIntegral {
 public:
  EdgeWaveIntegral(const EdgeWaveTerms& terms, double cos_cone, double sin_cone, double from, double to,
                   const std::array<double, 2>& corners)
      : terms_(terms), cos_cone_(cos_cone), sin_cone_(sin_cone), from_(from), to_(to), corners_(corners) {}

  /// At the wavenumber k [rad/m].
  WaveIntegrals over(const RayRow& row, double k) const;

  /// The sums in parts: what is beside the ends of the edge, and stretches of the rays between them, as k asks for. Over each of
  /// these the integral is e^{jk phase} times `whole`, with the phase of its middle, or the sum of two such terms, of its `ends`.
  /// Their amplitudes change slowly with k: those of `ends` where the phase turns by at least `least_turn` between middle and
  /// end, and otherwise `whole`, which turns by no more.
  WaveIntegrals beside_corners(const RayRow& row, double k) const;
  std::vector<RowStretch> stretches(const RayRow& row, double k) const;
  WaveIntegrals whole(const RayRow& row, const RowStretch& stretch, double k) const;
  struct Ends {
    WaveIntegrals from, to;
  };
  Ends ends(const RayRow& row, const RowStretch& stretch, double k) const;
  static constexpr double least_turn = 2.0;  // [rad]

 private:
  struct Samples;
  template <class Visit>
  void visit_rays(const RayRow& row, double k, Visit visit) const;
  template <class Visit>
  void visit_beside_corner(const RayRow& row, double k, double corner, double inwards, Visit visit) const;
  void add(const RayRow& row, const RowStretch& stretch, double k, WaveIntegrals& sum) const;
  Samples sampled(const RayRow& row, const RowStretch& stretch, double k) const;
  Samples beside_corner(const RayRow& row, const RowStretch& stretch, double k) const;

  const EdgeWaveTerms& terms_;
  double cos_cone_, sin_cone_, from_, to_;
  std::array<double, 2> corners_;
};

}  // namespace raytube
