// Maliuzhinets' function: what the fields at a wedge of impedance faces are made of.
#pragma once

#include <vector>

#include "core/field.h"

namespace raytube {

/// psi_Phi of a wedge whose free space is 2 Phi = n pi wide, n in (1, 2] (Maliuzhinets 1958, Sov. Phys. Dokl. 3, 752),
///   psi(z) = exp( -1/2 INT_0^inf (cosh zs - 1) / (s cosh(pi s/2) sinh(2 Phi s)) ds ),
/// even; over psi(pi/2), as only ratios count. The integrand is even in s and regular for |Im s| < 1/n, so that equal steps
/// converge exponentially; outside |Re z| <= pi/2, psi(z + pi/2) psi(z - pi/2) = psi(pi/2)^2 cos(z / 2n) (loc. cit.).
class MaliuzhinetsFunction {
 public:
  explicit MaliuzhinetsFunction(double n);
  Complex operator()(Complex z) const;

 private:
  Complex exponent(Complex z) const;

  double n_, step_;
  std::vector<double> weights_;  // of cosh zs - 1 at the multiples of the step
  Complex at_right_angle_;       // the exponent of psi(pi/2)
};

}  // namespace raytube
