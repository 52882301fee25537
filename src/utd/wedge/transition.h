// Transition function that carries a diffracted field smoothly through a shadow or reflection boundary.
#pragma once

#include "core/field.h"

namespace raytube {

/// How F is evaluated: to rounding, or as it was when tables were printed, to study what that costs.
enum class TransitionTier {
  exact,
  kouyoumjian_pathak,  // (1974): small-argument form, linear table of eight nodes from 0.3 to 5.5, large-argument series
  as_printed           // the same with the small-argument form as misprinted in secondary sources
};

/// F(X) = 2j sqrt(X) e^{jX} int_{sqrt X}^inf e^{-jt^2} dt of Kouyoumjian and Pathak (1974), for every X >= 0;
/// F(-|X|) = conj F(|X|). F(0) = 0 and F -> 1 for large X. Exact: relative error below 1e-15.
Complex transition(double x, TransitionTier tier = TransitionTier::exact);

}  // namespace raytube
