// Gauss-Legendre quadrature.
#pragma once

#include <span>

namespace raytube {

inline constexpr int most_gauss_points = 48;

struct GaussPoint {
  double node;    // in (0, 1)
  double weight;  // the weights of a rule add up to 1
};

/// The rule of `count` points, 1 <= count <= most_gauss_points: exact for polynomials of degree 2 count - 1.
std::span<const GaussPoint> gauss_rule(int count);

}  // namespace raytube
