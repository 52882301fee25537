// Waves that run along narrow rims into a flat tip, and from tip to tip.
#pragma once

#include <map>

#include "utd/corner/sheet_corner.h"
#include "utd/surface/local_look.h"
#include "utd/surface/strip_sum.h"
#include "utd/tip/flat_tips.h"

namespace raytube {

/// What tips do to waves along their rims is what corners of a sheet do (utd/corner).
///
/// A wave that comes to the edge of a sheet at the small angle delta has c_0 (k delta rho)^(-1/2) for a field across it, in the
/// spectrum over the edge (k - k_s)^(-1/4). So one that comes to a curved rim leaves
///   A(s) = e^(j pi/8) (k/2)^(1/4) / Gamma(1/4) INT (s - s')^(-3/4) u(s') e^(-jk(s - s')) ds'
/// there, u the incident wave on the rim; where the rim has bent out of its light, a half of Fock's hard current. The tip turns A
/// into waves back along the same rim and along the other one, r_ab, and radiation is the reverse of reception:
///   S = (lambda / j) SUM r_ab A_a A_b.
/// Rays from in front of a tip start waves there; those run along the rim to the next tip, or round the body to the same one, as
/// those between the corners of a sheet. Own derivation, valid when k rho of the rims is below 3 and the body flat at its tip:
/// docs/theory/surface_waves.md#flat-tips.
class FlatTipWaves {
 public:
  explicit FlatTipWaves(std::vector<FlatTip> tips);

  /// S of the waves of all tips, and over how many points of rims it is the sum.
  CountedSum scattering(const CurvedTarget& target, LocalLook& look, double wavenumber, StripPlaces* places) const;
  bool empty() const { return tips_.empty(); }

 private:
  /// r of waves along an edge: back along it, and into the other one.
  struct Reflection {
    Complex same, other;
  };
  class Visit;
  class Sum;

  const SheetCorner& corner(const FlatTip& tip) const;
  Reflection reflection_of(double angle) const;

  std::vector<FlatTip> tips_;
  std::map<long, SheetCorner> corners_;  // by the angle in 0.1 degrees
  std::vector<Reflection> reflections_;
};

}  // namespace raytube
