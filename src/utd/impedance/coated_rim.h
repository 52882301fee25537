// The rim of a coated metal plate whose thickness is small against the wavelength: what its border face, the narrow one between
// the two sides, changes in the fringe currents of a half plane with impedance faces.
//
// That half plane lies in the middle of the metal. Across the border face flows the H that it has at its edge, and the thickness
// of the metal changes the currents on the sides as it does those of a conductor (utd/multiple/thin_plate_edge.h): an engineering
// approximation, held against integral equations (docs/theory/materials.md). Valid when the metal is thinner than a tenth of the
// wavelength.
#pragma once

#include "utd/impedance/impedance_fringe.h"

namespace raytube {

/// What a wave meets at a rim.
struct RimFaces {
  std::array<SurfaceImpedance, 2> sides;
  SurfaceResponse border;  // what physical optics has there
  bool border_coated;
};

/// The cosine at which a wave meets the border face of a thin plate; not above 0 on its dark side.
double border_cosine(const Wedge& wedge, const dvec3& incident);

/// One look at one rim. Keeps references to its arguments.
class CoatedRim {
 public:
  /// `half_plane` is that of the same wedge, incidence and look.
  CoatedRim(const Wedge& wedge, const WedgeIncidence& incidence, const LookVectors& look, const ImpedanceEdge& half_plane)
      : wedge_(wedge), incidence_(incidence), look_(look), half_plane_(half_plane) {}

  /// S per length of edge beside that of the half plane.
  ScatteringMatrix amplitude(const RimFaces& of, double wavenumber) const;

 private:
  ScatteringMatrix optics_taken_off(const SurfaceResponse& border, double wavenumber) const;
  ScatteringMatrix border_current(const Wedge& metal, Complex field, double wavenumber) const;
  ScatteringMatrix sides(const Wedge& metal, double wavenumber) const;

  const Wedge& wedge_;
  const WedgeIncidence& incidence_;
  const LookVectors& look_;
  const ImpedanceEdge& half_plane_;
};

}  // namespace raytube
