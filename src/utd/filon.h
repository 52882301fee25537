// Integrals of a smooth function times a fast, linear phase (Filon 1928).
#pragma once

#include <array>

#include "field.h"

namespace raytube {

/// The rule of `count` Gauss points on [-1, 1]: sum of weights(theta)[i] f(at[i]) is the integral of f(x) e^{j theta x}, exact
/// for polynomials f of a degree below `count` at any theta (Bakhvalov & Vasil'eva 1968: Legendre series, whose terms have
/// spherical Bessel functions for moments).
template <int count>
class FilonRule {
 public:
  FilonRule();
  std::array<double, count> at;
  std::array<Complex, count> weights(double theta) const;

 private:
  std::array<double, count> gauss_;
  std::array<std::array<double, count>, count> legendre_;  // [i][n]: weight of point i times (2n + 1) P_n there
};

extern template class FilonRule<8>;
extern template class FilonRule<16>;

}  // namespace raytube
