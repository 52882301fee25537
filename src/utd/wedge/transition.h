// Transition function that carries a diffracted field smoothly through a shadow or reflection boundary.
#pragma once

#include "core/field.h"

namespace raytube {

/// F(X) = 2j sqrt(X) e^{jX} int_{sqrt X}^inf e^{-jt^2} dt of Kouyoumjian and Pathak (1974), for every X >= 0;
/// F(-|X|) = conj F(|X|). F(0) = 0 and F -> 1 for large X. Relative error below 1e-15.
Complex transition(double x);

}  // namespace raytube
