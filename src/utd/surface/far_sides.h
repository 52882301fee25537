// Where a curved surface ends at a wedge before its shadow boundary: its lit part near that boundary is there all the same.
#pragma once

#include <span>
#include <vector>

#include "math/band_sum.h"
#include "utd/surface/curved_target.h"
#include "utd/surface/local_look.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

/// What the excess of Fock's current over that of physical optics brings to the wedges at the far sides of lit conducting facets,
/// strip by strip; at all wavenumbers waves run over the same bodies. `band` has these wavenumbers.
std::vector<SurfaceArrival> far_side_arrivals(const CurvedTarget& target, LocalLook& look, std::span<const double> wavenumbers,
                                              BandSum& band);

}  // namespace raytube
