#include "utd/wedge/transition.h"

#include <cmath>

#include "math/erfc_ray.h"

namespace raytube {

// F(X) = sqrt(pi) z e^{z^2} erfc(z) with z = e^{j pi/4} sqrt(X): an identity of the definition.
Complex transition(double x) {
  const double root = std::sqrt(std::abs(x)), side = root * std::sqrt(pi / 2);
  const Complex value = Complex(side, side) * scaled_erfc(root);
  return x < 0 ? std::conj(value) : value;
}

}  // namespace raytube
