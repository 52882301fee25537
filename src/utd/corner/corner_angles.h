// What corners in meshes may be off those that are solved.
#pragma once

#include <cmath>

#include "core/field.h"

namespace raytube {

/// What the edges of a corner may be off a plane, as the sides of thin plates may [rad].
inline constexpr double off_plane = 0.05;
/// The angles between two edges at which corners are solved.
inline constexpr double least_corner = 15.0 * degree, greatest_corner = 165.0 * degree;

/// The multiple of 0.1 degrees [rad]: coordinates in single precision move angles of small sheets far from the origin.
inline double rounded_corner(double angle) { return std::round(10.0 * angle / degree) * 0.1 * degree; }

}  // namespace raytube
