// Integrals of a quadratic amplitude times a linear phase over a triangle, in closed form.
#pragma once

#include <array>
#include <span>

#include "core/field.h"

namespace raytube {

/// Divided difference of exp at the nodes j x_0, j x_1, ..., of which up to five may coincide or lie as close together as they
/// like; `x` ascends. Recursion where the nodes are spread, else the series of complete homogeneous polynomials about their mean
/// (McCurdy, Ng & Parlett 1984, Math. Comp. 43, 501). Absolute error below 1e-14.
Complex phasor_difference(std::span<const double> x);

/// Means over a triangle of lambda_i lambda_j e^{jx}, lambda its barycentric coordinates and x linear with the values given at
/// the corners (Hermite-Genocchi): 11, 22, 33, 12, 23, 31.
std::array<Complex, 6> triangle_moments(const std::array<double, 3>& x);

}  // namespace raytube
