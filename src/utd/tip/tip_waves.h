// What sharp tips send back to antennas behind them.
//
// E in the plane of the axis: the wave that grazes the body runs along it to the tip and returns, which physical optics lacks;
// its amplitude is that of an infinite cone's tip, k S = A(half angle, look), tip_table.h. Where the body bends on the way to the
// tip, the wave comes there and leaves with Fock's factor each. docs/theory/surface_waves.md#tips.
#pragma once

#include "utd/surface/local_look.h"
#include "utd/surface/strip_sum.h"
#include "utd/tip/tips.h"

namespace raytube {

/// S [m] at each wavenumber. Valid for one antenna, and for two where the cone's amplitude differs little from one to the other.
std::vector<ScatteringMatrix> tip_scattering(const CurvedTarget& target, std::span<const Tip> tips, LocalLook& look,
                                             std::span<const double> wavenumbers, StripPlaces* places);

}  // namespace raytube
