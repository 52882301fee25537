// Physical optics on a piece of a curved surface lit by a plane wave.
#pragma once

#include <vector>

#include "math/chebyshev.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/curved/curved_piece.h"
#include "sbr/launch/convex_polygon.h"

namespace raytube {

/// What lights a look and what is asked of it.
struct Illumination {
  const LaunchGrid& grid;
  const SphericalBasis& transmit;
  const SphericalBasis& receive;
  SpectralSurfaces surfaces;
  Band* band = nullptr;  // of the wavenumbers, many of which are then interpolated to 1e-12; null: each is computed
  const Spectrum* behind_sheets = nullptr;  // the wave that lights the look once it has gone through sheets
  bool returns_alone = false;               // the currents that radiate the reflected wave, without its shadow
};

/// Far field of the physical-optics currents on the piece within a launch rectangle, [frequency]. With s the direction to the
/// receiver, d that of the incident wave and p, e the polarisations of both,
///   S = -(jk / 4 pi) p . integral of 2 n x (d x e) e^{jk (s - d).r} over the lit surface,
/// in launch coordinates, where the surface element carries n x (d x e) dS = [p.e + (p.d) (e . grad depth)] du dv. On other
/// materials than a perfect conductor, at every point the currents of the plane that touches the surface.
/// What rough surfaces scatter incoherently is added to `incoherent`, if it is given.
std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const Bounds& cell,
                                               TubeSums* incoherent = nullptr);

/// Far field [frequency] of the part over a convex polygon of the launch plane that stays clear of the shadow boundary.
std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const ConvexPolygon& polygon,
                                               TubeSums* incoherent = nullptr);

/// The range of the exponent of that integral over a rectangle, divided by the wavenumber [m].
double path_range(const Illumination& light, const CurvedPiece& piece, const Bounds& cell);

}  // namespace raytube
