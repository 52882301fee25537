// Bessel functions of any order, rounded alike on all systems: those of the standard library take the gamma function from the C
// library where arguments are small against the order, or below 2 (math/special/elementary.h).
#pragma once

namespace raytube {

/// J of order nu >= 0 at x > 0.
double bessel_j(double nu, double x);

/// Y of order nu >= 0 at x > 0.
double bessel_y(double nu, double x);

}  // namespace raytube
