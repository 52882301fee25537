// One strip along its geodesic. Notation in multiple_diffraction.h.
#pragma once

#include "utd/multiple/strip_path.h"

namespace raytube {

/// The wedge at the end of a strip and the direction in which it gets there; no wedge where it does not end at one.
struct StripArrival {
  WedgeSide at;
  dvec3 direction{0.0};
};

/// Fills in the points of a strip over a curved face, its length and its end.
StripArrival walk_strip(const StripScene& scene, StripPath& path);

}  // namespace raytube
