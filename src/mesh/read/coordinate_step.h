// How finely a mesh file can place a vertex.
#pragma once

#include <span>

#include "core/field.h"

namespace raytube {

/// The step between neighbouring coordinates where they are largest, as the points tell: that of single precision if all of them
/// are numbers of it, in text too, and that of the digits of a text file (0: binary). 0 for numbers that are exact as far as one
/// can tell: of double precision, or round ones.
double coordinate_step(std::span<const dvec3> points, int digits);

}  // namespace raytube
