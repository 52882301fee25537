#include "utd/wedge/transition.h"

#include <cmath>

#include "utd/wedge/scaled_erfc.h"

namespace raytube {

// F(X) = sqrt(pi) z e^{z^2} erfc(z) with z = e^{j pi/4} sqrt(X): an identity of the definition.
Complex transition(double x, TransitionTier tier) {
  const double root = std::sqrt(std::abs(x)), side = root * std::sqrt(pi / 2);
  Reals alone{};
  alone[0] = root;
  const Complex value = Complex(side, side) * scaled_erfc_of(tier)(alone)[0];
  return x < 0 ? std::conj(value) : value;
}

}  // namespace raytube
