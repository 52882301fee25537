// What the currents on lit curved surfaces have beside physical optics, over their facets.
#pragma once

#include <span>
#include <vector>

#include "utd/surface/curved_target.h"
#include "utd/surface/local_look.h"
#include "utd/surface/strip_sum.h"

namespace raytube {

/// Adds S to `sum` and returns what that cost (utd/wedge/work.h); perfect conductors. `places` may be null.
double add_lit_currents(const CurvedTarget& target, LocalLook& look, std::span<const double> wavenumbers, BandSum& sum,
                        StripPlaces* places);

}  // namespace raytube
