// A wave at the boundary between a solid and vacuum, met from either side.
//
// The central header of this folder: waves that refract into bodies filled with a medium, go on inside and leave. refraction is
// one meeting, solid_ray a ray from one to the next, solid_tubes bundles of rays and what their fields radiate outside.
#pragma once

#include "scene/layers.h"

namespace raytube {

/// Ratios of electric fields in the basis of SurfaceResponse, and how the wave behind the boundary goes on. E of a wave in a
/// medium is sqrt(mu / eps) times its eta H, across its direction.
struct Refraction {
  SurfaceResponse ratio;
  double cosine = 0.0;       // of the angle of refraction; 0: no wave goes on (total reflection)
  double index = 1.0;        // phase per vacuum phase along its direction
  double attenuation = 0.0;  // a wave falls off as e^{-k attenuation length}
};

/// `slowness`: tangential wavenumber over that of vacuum, real. What decays behind the boundary decays along its normal (Born &
/// Wolf 1999, section 14.2), exactly so from vacuum into a plane layer.
Refraction refraction(const Medium& from, const Medium& into, double slowness);

}  // namespace raytube
