// The current on the lit side of a convex surface, point by point.
#pragma once

#include "mesh/smooth/curvature_field.h"
#include "utd/fock/face_impedances.h"
#include "utd/fock/fock.h"

namespace raytube {

/// How a plane wave meets a curved surface. The surface seen along the wave, with tangent vectors W = w - d (n . w) / (n . d) for
/// w across the wave, has the second fundamental form C(w, w') = II(W, W'); its axes are those of the wave it reflects (Deschamps
/// 1972, Ray techniques in electromagnetics, Proc. IEEE 60, 1022). On a cylinder, at any incidence, they are those of the wave's
/// parts with E or H across its axis.
struct LitFrame {
  /// `incident_direction` is unit, against frame.normal.
  LitFrame(const SurfaceFrame& frame, const dvec3& incident_direction);

  dvec3 normal;
  dvec3 bent, straight;  // unit, across the wave: axes of C with its larger and its smaller curvature
  double cosine;         // -n . d
  double bend;           // their difference over |n . d| [1/m], less what the smaller one is hollow by; not negative

  /// xi < 0, from the shadow boundary in units of its width: |xi|^3 = k / (2 bend). It is Fock's near the boundary, exactly so on
  /// cylinders; and elsewhere 1 +- j / (4 xi^3) is the current to the second order in 1/k on any surface at normal incidence.
  double distance(double wavenumber) const { return -std::cbrt(0.5 * wavenumber / bend); }
};

/// From this |xi| on the current is that of physical optics.
inline constexpr double least_lit = 5.0;

/// What the current has beside physical optics, in units of that: for H along `straight` (hard) and E along it (soft).
FockCurrents lit_excess(const LitFrame& frame, double wavenumber);

/// The same excess on a surface of an impedance, in units of what a perfect conductor has in physical optics: J alone; M = -Z n x
/// J.
FockCurrents lit_excess(const LitFrame& frame, double wavenumber, const FaceImpedance& impedance);

}  // namespace raytube
