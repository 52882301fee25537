// W(x) of erfc_ray.h by transition functions of different accuracy.
#pragma once

#include "math/lanes.h"
#include "scene/options.h"

namespace raytube {

/// W for as many arguments as there are lanes, each x >= 0.
using ScaledErfc = Complexes (*)(const Reals& x);

/// W(x) = F(x^2) / (sqrt(pi) e^{j pi/4} x) with the F of this tier.
ScaledErfc scaled_erfc_of(TransitionTier tier);

}  // namespace raytube
