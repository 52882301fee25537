// Quadrature over chords of a curved piece.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/field.h"
#include "math/gauss.h"

namespace raytube {

// Points enough for e^{jx} over a range of x: a rule of n points has the polynomials up to 2n - 1, and the Legendre series of
// e^{jx} ends soon after half the range (Trefethen 2013, Approximation theory and practice, chapter 8).
inline int points_for(double phase_range) { return std::min(5 + static_cast<int>(0.3 * phase_range), most_gauss_points); }

// On the limb the depth ends like a square root; x = -cos takes that out of the integrand.
template <class Function>
void for_points(double low, double high, bool at_shadow_boundary, double phase_range, Function function) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  for (const GaussPoint& point : gauss_rule(points_for(at_shadow_boundary ? 1.6 * phase_range + 8.0 : phase_range))) {
    if (at_shadow_boundary)
      function(middle - half * std::cos(pi * point.place), half * pi * std::sin(pi * point.place) * point.weight);
    else
      function(middle + half * (2.0 * point.place - 1.0), 2.0 * half * point.weight);
  }
}

}  // namespace raytube
