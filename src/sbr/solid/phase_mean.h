// Phase integrals of waves that also decay.
#pragma once

#include <array>

#include "core/field.h"

namespace raytube {

/// Mean of e^{jx} over a triangle on which x is linear, from x at its corners, with imaginary parts not below zero: twice the
/// second divided difference of -e^{jx} (Hermite-Genocchi).
Complex triangle_phase_mean(std::array<Complex, 3> x);

}  // namespace raytube
