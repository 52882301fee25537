// Strips over curved faces as polylines, with what runs along them.
#pragma once

#include "scene/surface_rays.h"
#include "utd/multiple/strip_path.h"

namespace raytube {

/// Appends the strip, if its face is curved, and those that follow from it, as at a wavenumber; `order` strips one after another,
/// this one included, have led here. Currents are the fringe currents that unit eta H (hard) and unit E (soft, over cos(beta')
/// what flows along the strip; singular at the edge, where the next point's stands) along the edge start: all there is in the
/// dark, what physical optics lacks in the light.
void add_rays(const StripPath& path, double wavenumber, int order, std::vector<SurfaceRay>& rays);

}  // namespace raytube
