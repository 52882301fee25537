// Maliuzhinets' function: what the fields at a wedge of impedance faces are made of.
#pragma once

#include <map>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Where products of the function are asked for: all of it that does not depend on the faces.
struct MaliuzhinetsPoint {
  Complex at;                  // w
  std::vector<Complex> turns;  // cos((w - pi/2) / n) at w, w - pi ... as far as Re w > pi/2
  Complex square;              // square of what is left of w, as the integrand's value at 0 has it
  std::vector<Complex> waves;  // cosh(ws) of that, at the nodes
};

inline constexpr double full_digits = 32.0;

/// psi_Phi of a wedge whose free space is 2 Phi = n pi wide, n in (1, 2] (Maliuzhinets 1958, Sov. Phys. Dokl. 3, 752),
///   psi(z) = exp( -1/2 INT_0^inf (cosh zs - 1) / (s cosh(pi s/2) sinh(2 Phi s)) ds ),
/// even; over psi(pi/2), as only ratios count. The integrand is even in s and regular for |Im s| < 1/n, so that equal steps
/// converge exponentially.
class MaliuzhinetsFunction {
 public:
  /// e^{-digits} of a product is left out.
  explicit MaliuzhinetsFunction(double n, double digits = full_digits);

  MaliuzhinetsPoint point(Complex w) const;

 private:
  friend class MaliuzhinetsPair;
  std::vector<Complex> waves(Complex z) const;

  double n_, step_, at_zero_;    // at_zero: of z^2 in the sum
  std::vector<double> weights_;  // weights of cosh zs - 1 at the multiples of the step
  double right_angle_;           // the exponent of psi(pi/2)
};

/// psi(w + a) psi(w - a) of one a, |Re a| <= pi/2: even in both. Their integrands have the sum 2 cosh(ws) cosh(as) - 2, and from
/// psi(z + pi/2) psi(z - pi/2) = psi(pi/2)^2 cos(z / 2n) (loc. cit.) the product at w, times that at w - pi, is (cos((w -
/// pi/2)/n)
/// + cos(a/n)) / 2.
class MaliuzhinetsPair {
 public:
  MaliuzhinetsPair(const MaliuzhinetsFunction& psi, Complex a);

  Complex operator()(const MaliuzhinetsPoint& w) const;

 private:
  std::vector<Complex> waves_;  // cosh(as), with its weights
  Complex constant_, turn_;
};

/// The functions of all wedges that are asked for.
class MaliuzhinetsFunctions {
 public:
  explicit MaliuzhinetsFunctions(double digits) : digits_(digits) {}
  const MaliuzhinetsFunction& at(double n) { return made_.try_emplace(n, n, digits_).first->second; }

 private:
  double digits_;
  std::map<double, MaliuzhinetsFunction> made_;
};

}  // namespace raytube
