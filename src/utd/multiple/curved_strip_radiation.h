// What strips over curved faces radiate, and those that follow from them. Notation in multiple_diffraction.h.
#pragma once

#include "utd/multiple/strip_path.h"

namespace raytube {

/// Unit waves that start a strip, per transmit polarisation, with quadrature weight and phase [m]: eta H along the edge, E along
/// it, and what of E goes on along the strip.
struct StripStart {
  std::array<Complex, 2> magnetic, electric, lying;
};

/// Adds S [m] of the strip at a wavenumber to `own`, and of those that follow from it to `further`.
void radiate(const StripPath& path, double wavenumber, const StripStart& start, ScatteringMatrix& own, ScatteringMatrix& further);

}  // namespace raytube
