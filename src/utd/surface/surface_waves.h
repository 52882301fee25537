// Waves at the shadow boundaries of curved surfaces and beyond them.
//
// Physical optics stops sharply where a smooth surface turns dark. The current does not: it falls off over a width 1 / (m kappa),
// m = (k / 2 kappa)^(1/3), and runs on into the dark along geodesics, as Fock found (1946). What it has beside physical optics is
// integrated over lit facets near the boundary, and along strips from it into the dark. docs/theory/surface_waves.md.
//   fock              the current as a function of the distance from the boundary
//   lit_frame         the current at a lit point, lit_currents its integral over facets
//   shadow_boundary   the boundary of a look, in pieces
//   surface_ray       geodesics over facets, geodesic_march strips along them
//   surface_waves     strips from the boundary, their sum
#pragma once

#include <span>
#include <vector>

#include "scene/surface_rays.h"
#include "utd/surface/conical_tip.h"
#include "utd/surface/curved_target.h"
#include "utd/surface/local_look.h"
#include "utd/surface/strip_sum.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

struct SurfaceWaveResult {
  std::vector<ScatteringMatrix> scattering;  // [frequency], S [m], phase reference that of the look
  std::vector<SurfaceArrival> arrivals;      // hard waves that reach wedges; their radiation from there on is not in `scattering`
  std::uint64_t strips = 0;
  double work = 0.0;  // counted (utd/wedge/work.h)
};

/// What the currents on convex curved surfaces have beside physical optics in one look: perfect conductors, light that comes
/// straight from the transmitter, whose wave is plane over the width of a shadow boundary: its distance R is large beside
/// 1 / (m kappa), the next order is xi / (m kappa R). `frequencies` must not be empty. `places`, if not null, takes
/// `scattering` at one of them point by point of the surface; `rays`, if not null, the strips as polylines, with the whole
/// current at the first frequency, physical optics included.
SurfaceWaveResult surface_wave_scattering(const CurvedTarget& target, const LocalLook& look, std::span<const double> frequencies,
                                          StripPlaces* places = nullptr, std::vector<SurfaceRay>* rays = nullptr,
                                          std::span<const ConicalTip> tips = {});

}  // namespace raytube
