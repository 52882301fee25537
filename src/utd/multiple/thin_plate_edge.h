// The edge of a plate whose thickness t is small against the wavelength: what its edge face, the narrow face between the two
// sides, changes in the currents of a half plane. Derived in docs/theory/edges_derivation.md. Source: the split functions of the
// thick half plane, Jones (1953), Proc. R. Soc. Lond. A 217, 153, to the leading order in t / wavelength at each of their
// arguments,
//
//   F(phi) = exp{ j kappa (L cos phi + phi sin phi) },  kappa = t sin(beta') / wavelength,  L = 1 - gamma - ln kappa - j pi/2,
//
// phi the angle between a direction and the plate continued beyond its edge, phi' that of the source. Valid for kappa < 0.1: the
// error is then 0.02 of a wavelength at most, in units in which a half plane has an amplitude of about 0.5.
#pragma once

#include "utd/multiple/strip_kernels.h"

namespace raytube {

/// The share of one side of the plate in what the thickness changes. The base is the half plane amid the edge face, and physical
/// optics on the two sides of the plate, where they are, and on the edge face.
class ThinPlateCorrection {
 public:
  /// `half_cosine` is h of the observer, as for Strip, `scattered` is s. `direct`: the wave comes from outside; else it came over
  /// one side and grazes this face (lit) or the other one (dark).
  ThinPlateCorrection(const Wedge& wedge, int face, const FaceIncidence& incidence, double half_cosine, const dvec3& scattered,
                      bool direct);

  /// The change of a semi-infinite face's kernels at `wavenumber` [rad/m].
  FringeKernels untruncated(double wavenumber) const;

  /// Changes the kernels of a strip of electrical length `length`, those of a half plane, into those of the thin plate;
  /// `half_plane` are its untruncated ones.
  void correct(StripKernels& kernels, const FringeKernels& half_plane, double wavenumber, double length) const;

 private:
  double width_;                 // t sin(beta') [m]
  double beyond_;                // cos(phi/2) where it is above 1: no angle at all, the observer is beyond the cone
  double half_cosine_;           // cos(phi/2)
  double cosine_, sine_, turn_;  // cos phi, sin phi, phi sin phi
  double source_half_cosine_;    // cos(phi'/2)
  double source_half_sine_;      // sin(phi'/2), negative for a source behind this face
  double source_cosine_, source_sine_, source_turn_;
  double above_;     // s . n_f / sin(beta')
  double lit_sign_;  // +1 on the lit face, -1 on the dark one, 0 for a wave from the plate itself
};

/// True if the wave comes along the plate, over both its sides at once. The strips of its sides then start at the edge at its
/// other end, but the wave itself, which the plate does not disturb, has its current on this edge face too.
bool comes_along_plate(const Wedge& wedge, const dvec3& incident);

/// F(phi'), H along the edge on the edge face of unit H of the wave.
Complex field_at_edge(const Wedge& wedge, const FaceIncidence& arriving, double wavenumber);

/// S per unit length of the current on the edge face itself, less its physical optics.
ScatteringMatrix edge_face_amplitude(const Wedge& wedge, const WedgeIncidence& incidence, const LookVectors& look,
                                     double wavenumber);

}  // namespace raytube
