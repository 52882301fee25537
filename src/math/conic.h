// A conic of the launch plane: the shadow boundary of a curved surface.
#pragma once

#include <array>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Real roots of a x^2 + b x + c, ascending; infinite ones where a = 0, NaN where there are none.
std::array<double, 2> quadratic_roots(double a, double b, double c);

/// The curve on which c + g . p + p . m p is zero; positive inside. `m` is symmetric.
struct Conic {
  double c = 0.0;
  dvec2 g{0.0};
  glm::dmat2 m{0.0};

  double operator()(const dvec2& p) const { return c + glm::dot(g, p) + glm::dot(p, m * p); }
};

/// The part [low, high] of a line parallel to an axis that lies inside, and whether the curve ends it.
struct Chord {
  double low = 0.0, high = 0.0;
  bool cut = false;
};

/// Chord of the points whose other coordinate is `row`, those with coordinate `axis` in [low, high]; of two parts the one towards
/// the origin.
Chord chord(const Conic& conic, int axis, double row, double low, double high);

/// The rows between row_low and row_high, in ascending order, where chord() is not a smooth function of the row: where the curve
/// passes low or high, and where it turns back.
std::vector<double> breaks(const Conic& conic, int axis, double low, double high, double row_low, double row_high);

}  // namespace raytube
