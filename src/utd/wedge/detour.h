// How much longer the way over another point of an edge is.
#pragma once

#include <algorithm>
#include <cmath>

namespace raytube {

/// sqrt(rho^2 + (u + step)^2) less its linear part in the step, which leaves out what the two halves of a ray over an edge have
/// with opposite signs: no difference of long ways is taken.
inline double excess(double rho, double u, double step) {
  const double length = std::hypot(rho, u), stepped = std::hypot(rho, u + step), sum = length + stepped;
  return step * step * std::max(0.0, 1 - u / length * (2 * u + step) / sum) / sum;
}

}  // namespace raytube
