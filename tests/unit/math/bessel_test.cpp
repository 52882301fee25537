// Bessel functions against the standard library's: equal but for rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "math/special/bessel.h"

namespace raytube {
namespace {

// 1e-13 of the larger of the two, by which modes are told: rounding of some hundred terms.
TEST(Bessel, FunctionsAreThoseOfTheStandardLibrary) {
  for (const double x : {0.01, 0.3, 1.0, 1.9, 1.999999, 2.0, 3.5, 7.0, 12.0})
    for (double nu = 0.0; nu < 25.0; nu += 0.31) {
      const double j = std::cyl_bessel_j(nu, x), y = std::cyl_neumann(nu, x);
      EXPECT_NEAR(bessel_j(nu, x), j, 1e-13 * std::abs(j) + (x > 2 ? 1e-15 : 0.0)) << nu << ' ' << x;
      EXPECT_NEAR(bessel_y(nu, x), y, 1e-13 * std::hypot(j, y)) << nu << ' ' << x;
    }
}

}  // namespace
}  // namespace raytube
