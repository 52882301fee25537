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

/// What tips send back, and along how many of their sides waves were followed. Valid for one antenna, and for two where the
/// cone's amplitude differs little from one to the other.
CountedSum tip_scattering(const CurvedTarget& target, std::span<const Tip> tips, LocalLook& look, double wavenumber,
                          StripPlaces* places);

}  // namespace raytube
