// What strips over curved faces radiate, and those that follow from them. Notation in multiple_diffraction.h.
#pragma once

#include "math/path_bins.h"
#include "utd/multiple/strip_path.h"

namespace raytube {

/// Unit waves that start a strip, per transmit polarisation, with quadrature weight and phase [m]: eta H along the edge, E along
/// it, and what of E goes on along the strip.
struct StripStart {
  std::array<Complex, 2> magnetic, electric, lying;
  double path;  // of that phase, but for a constant of all wavenumbers [m]
};

/// Adds S [m] of the strip at a node of the bins to `own`, and of those that follow from it to `further`.
void radiate(const StripPath& path, std::size_t node, const StripStart& start, PathBins& own, PathBins& further);

}  // namespace raytube
