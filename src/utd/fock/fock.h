// Fock's currents at the shadow boundary of a convex surface (Fock 1946, J. Phys. USSR 10, 130).
#pragma once

#include <cmath>

#include "core/field.h"

namespace raytube {

/// G and F of a distance xi from the shadow boundary in units of its width, > 0 in the dark:
///   G(xi) = (e^{j pi/6} / 2 pi) integral e^{-j xi tau} / (e^{-j 2 pi/3} Ai'(tau e^{-j 2 pi/3})) dtau,
///   F(xi) = (e^{-j pi/3} / 2 pi) integral e^{-j xi tau} / Ai(tau e^{-j 2 pi/3}) dtau,
/// from infinity e^{-j 2 pi/3} over 0 to +infinity. In the dark u = u_i(Q) e^{-jks} G with H along the binormal (hard), and eta J
/// = E(Q) e^{-jks} F / m with E along it (soft); both fall as their first creeping wave. Error 4e-6.
struct FockCurrents {
  Complex hard, soft;
};
FockCurrents fock_in_the_dark(double xi);

/// A way through the dark, whatever the frequency.
class DarkWay {
 public:
  /// A step over h [m] of a surface with that normal curvature along the way [1/m] and that Gaussian one.
  void step(double curvature, double gaussian, double h);

  double distance(double wavenumber) const { return std::cbrt(wavenumber) * distance_; }  // xi
  double bend() const { return distance_; }                                               // xi k^(-1/3) [m^(1/3)]

  /// As fock_in_the_dark, with the creeping waves' propagation constants to their second order in m^-1: those of the zeros of
  /// H'(kr) and H(kr) on a cylinder (Olver 1954), and, hard, of (sqrt(r) H(kr))' where the surface bends across the way as on a
  /// sphere (Kouyoumjian 1975, table 1). Changes of the curvature along the way are left out, and bends across it count up to
  /// those along it.
  FockCurrents currents(double wavenumber) const;

  /// Currents of the first order with the second one of a conductor's.
  FockCurrents with_second_order(const FockCurrents& first, double wavenumber) const;

  /// m = (k / 2 kappa)^(1/3), its mean over xi; not at the start of the way.
  double scale(double wavenumber) const;

 private:
  double distance_ = 0.0;                     // integral of (kappa^2 / 2)^(1/3) [m^1/3]
  double bends_ = 0.0;                        // integral of kappa^(1/3) [m^2/3]
  double hard_more_ = 0.0, soft_more_ = 0.0;  // [m^-1/3]
};

/// What the currents of physical optics are to be multiplied by on the lit side, xi < 0:
///   G e^{-j xi^3/3} / 2 and F e^{-j xi^3/3} / (-2 xi).
/// Error 1e-6, and 1 + O(xi^-3) far off.
FockCurrents fock_factors(double xi);

}  // namespace raytube
