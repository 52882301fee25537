// Integrals of a quadratic amplitude times a linear phase over a triangle, in closed form.
#pragma once

#include <array>

#include "core/field.h"

namespace raytube {

/// Means over a triangle of lambda_i lambda_j e^{jx}, lambda its barycentric coordinates and x linear with the values given at
/// the corners (Hermite-Genocchi): 11, 22, 33, 12, 23, 31. Absolute error below 1e-14 for any corners, equal ones too.
std::array<Complex, 6> triangle_moments(const std::array<double, 3>& x);

}  // namespace raytube
