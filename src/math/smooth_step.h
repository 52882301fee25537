// A step without kinks.
#pragma once

#include <algorithm>

namespace raytube {

/// 0 up to x = 0, 1 from x = 1 on, 3 x^2 - 2 x^3 between.
inline double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace raytube
