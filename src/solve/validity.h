// How large a target is, and its features, against the wavelengths it is looked at with.
#pragma once

#include "plan/target.h"
#include "scene/sweep.h"
#include "scene/validity.h"

namespace raytube {

/// `outermost` are points of the target as wide as all of it (scene/sampling.h).
Validity validity_of(const Target& target, const Sweep& sweep, std::span<const dvec3> outermost);

}  // namespace raytube
