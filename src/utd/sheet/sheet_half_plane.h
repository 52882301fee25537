// The current of a sheet that ends in a straight edge, waves of any direction. Notation in sheet_admittance.h.
//
// Curl and divergence of the current are C = Z_C(-nu) Phi_C(nu) and D = Z_D(-nu) Phi_D(nu), Z the split functions. Where the
// field e^{jcx} drives it, Phi has the term 2 j E Z(-c) N(nu, c) / (nu + c), N = y at nu = -c; besides constants, Phi_D one and
// Phi_C two, of which there is one without polarisation across the sheet. They follow from
//   nu D + b C = 0 at nu = +-j |b|: the current has a finite transform, and no wave e^{-k |b| x} leaves the edge,
//   Phi_C(u) = Phi_C(-u) / (2 Z_C(-u)^2) at the root u of constant + normal a2: E along the edge is continuous there.
// Senior (1979), Radio Sci. 14, 645, for sheets at normal incidence; derived in docs/theory/material_edges.md.
#pragma once

#include <span>
#include <vector>

#include "utd/sheet/sheet_admittance.h"
#include "utd/sheet/split_function.h"

namespace raytube {

/// A wave along x, and what the formulas need of it.
struct SheetWave {
  Complex nu, a2;
  Complex fit;                        // y(a2) less constant + normal a2, divergence: less its constant
  Complex end_face, normal_end_face;  // e^{-nu L} of the two displacements
};

/// A wave that drives the current, with e^{jcx}: E of its channel times Z(-c), finite also for waves that the sheet guides.
struct SheetSource {
  SheetChannel channel;
  SheetWave wave;     // nu = c
  Complex strength;   // E Z(-c)
  Complex component;  // what E has along the edge (curl) or across it (divergence), times Z(-c)
};

/// What of the brackets Phi the conditions at the edge make up.
struct EdgeConstants {
  Complex curl, curl_slope, divergence, fit_curl, fit_divergence;
};

/// Current wave e^{-jk v x} that leaves the edge, v = sin_cone * `along`: its amplitude is weight Phi(v).
struct LaunchedWave {
  SheetChannel channel;
  SheetWave wave;
  Complex along;  // v / sin_cone
  Complex weight;
};

/// Across and along the edge.
struct SheetVector {
  Complex across, along;

  friend SheetVector operator*(Complex factor, const SheetVector& v) { return {factor * v.across, factor * v.along}; }
  friend SheetVector operator-(const SheetVector& a, const SheetVector& b) { return {a.across - b.across, a.along - b.along}; }
};

/// The current of a unit wave e^{-jk nu x} of a channel, and of one that arrives as e^{-jk nu x} with nu < 0.
SheetVector current_of(SheetChannel channel, Complex nu, Complex a2, double b);

/// One sheet at one angle of the cone; its tables do not depend on the sign of b. `sheet` must outlive it.
class SheetHalfPlane {
 public:
  /// `shortest` is the least electrical length k l sin_cone^2 of strips that its waves are followed over.
  SheetHalfPlane(const SheetAdmittance& sheet, double slowest, double sin_cone, double shortest);

  double sin_cone() const { return sin_cone_; }

  SheetWave complex_wave(SheetChannel channel, Complex nu) const { return fitted_wave(channel, nu, nu); }

  /// The two sources of a plane wave with the tangential field `incident` at the edge; c is not 0 where b is.
  std::array<SheetSource, 2> plane_wave(double c, double b, const SheetVector& incident) const;
  /// A unit current wave of a channel that arrives at the edge as e^{jcx}, c the root for a2 that is near to this one.
  SheetSource arriving(SheetChannel channel, Complex a2, Complex near) const;

  EdgeConstants constants(std::span<const SheetSource> sources, double b) const;

  /// Phi of a channel.
  Complex bracket(std::span<const SheetSource> sources, const EdgeConstants& constants, SheetChannel channel,
                  const SheetWave& at) const;

  /// Integral of eta J e^{jk nu x} k dx over the sheet.
  SheetVector moment(std::span<const SheetSource> sources, const EdgeConstants& constants, double nu, double b) const;

  /// That of the current the plate has far from its edge, as it enters the integral at the edge.
  SheetVector physical_optics(double nu, double c, double b, const SheetVector& incident) const;

  std::span<const LaunchedWave> launched() const { return launched_; }

 private:
  /// The fit is that of the cosine `within`, here and in split; of homogeneous waves it is mended to what the plate has exactly.
  SheetWave fitted_wave(SheetChannel channel, Complex nu, Complex within) const;
  SheetWave real_wave(SheetChannel channel, double nu, double within) const;
  Complex split(SheetChannel channel, Complex nu, Complex within) const;
  Complex split(SheetChannel channel, Complex nu) const { return split(channel, nu, nu); }
  Complex bare(const SheetSource& source, Complex nu) const;
  Complex fitted(const SheetSource& source, const SheetWave& at) const;
  void launch(SheetChannel channel, const SplitFunction& function, double slowest, double shortest);
  void constants_at_normal(std::span<const SheetSource> sources, EdgeConstants& result) const;
  void constants_on_cone(std::span<const SheetSource> sources, double b, EdgeConstants& result) const;
  std::array<Complex, 2> sums(std::span<const SheetSource> sources, Complex nu, bool fitted) const;

  const SheetAdmittance& sheet_;
  double sin_cone_, cone2_;  // b^2
  SplitFunction curl_, divergence_;
  Complex root_, ratio_;                              // u, 1 / (2 Z_C(-u)^2)
  std::array<Complex, 2> tie_curl_, tie_divergence_;  // Z(-j |b|) and Z(j |b|)
  Complex tie_fit_;                                   // fit of the divergence where s = 1
  std::vector<LaunchedWave> launched_;
};

/// Exact less physical optics, for a plane wave; regular at nu = -c.
SheetVector sheet_fringe(const SheetHalfPlane& half_plane, double nu, double c, double b, const SheetVector& incident);

}  // namespace raytube
