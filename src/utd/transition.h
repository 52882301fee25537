// Functions that carry a diffracted field smoothly through a shadow or reflection boundary.
#pragma once

#include "field.h"

namespace raytube {

/// Faddeeva function w(z) = e^{-z^2} erfc(-jz), valid for Im z >= 0; absolute error below 1e-14 on the ray used by transition().
Complex faddeeva(Complex z);

/// Transition function F(X) = 2j sqrt(X) e^{jX} int_{sqrt X}^inf e^{-jt^2} dt of Kouyoumjian and Pathak (1974),
/// absolute error below 1e-14 for every X >= 0; F(-|X|) = conj F(|X|). F(0) = 0 and F -> 1 for large X.
Complex transition(double x);

}  // namespace raytube
