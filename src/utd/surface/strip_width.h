// The width of a strip along a geodesic.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

/// w'' = -K w, exactly for the K of each step.
struct StripWidth {
  double width, slope = 0.0;
  int caustics = 0;                      // passed
  static constexpr double small = 1e-3;  // the K h^2 up to which two terms of cosine and sine are enough

  void step(double gaussian, double h) {
    const double turn = gaussian * h * h;
    double c = 1.0 - 0.5 * turn * (1.0 - turn / 12.0), s = h * (1.0 - turn / 6.0 * (1.0 - turn / 20.0));
    if (std::abs(turn) > small) {
      const double root = std::sqrt(std::abs(gaussian)), x = root * h;
      c = gaussian > 0.0 ? std::cos(x) : std::cosh(x);
      s = (gaussian > 0.0 ? std::sin(x) : std::sinh(x)) / root;
    }
    const double before = width;
    width = c * width + s * slope;
    slope = c * slope - gaussian * s * before;
    if (before * width < 0.0) ++caustics;
  }

  /// How far it is to where its sides would meet if they went on straight, or from there.
  double to_focus() const { return std::abs(width) / std::max(std::abs(slope), std::numeric_limits<double>::min()); }
};

}  // namespace raytube
