// Integrals of a smooth function times a fast, linear phase (Filon 1928).
#pragma once

#include <array>

#include "math/lanes.h"

namespace raytube {

/// The rule of eight Gauss points on [-1, 1]: sum of weights(theta)[i] f(at[i]) is the integral of f(x) e^{j theta x}, exact for
/// polynomials f of a degree below eight at any theta (Bakhvalov & Vasil'eva 1968: Legendre series, whose terms have spherical
/// Bessel functions for moments).
class FilonRule {
 public:
  static const FilonRule& get();
  Reals at;
  Complexes weights(double theta) const;

  /// Weights of the two ends apart: weights(theta) = e^{-j theta} begin + e^{j theta} end. Both change slowly with theta; they
  /// cancel more and more below |theta| of about 2.
  struct Ends {
    Complexes begin, end;
  };
  Ends end_weights(double theta) const;

 private:
  FilonRule();
  Reals gauss_;
  std::array<Reals, lanes> legendre_;  // [n][i]: weight of point i times (2n + 1) P_n there, the sign of j^n with it
};

/// The integral of amplitude e^{j phase} over a step on which both are linear, the amplitude from a to b: the step's length times
/// even (a + b) + odd (b - a). From e^{j phase} at the step's two ends, and the phases themselves.
struct FilonStep {
  Complex even, odd;
};
FilonStep filon_step(double phase_from, double phase_to, Complex at_from, Complex at_to);

}  // namespace raytube
