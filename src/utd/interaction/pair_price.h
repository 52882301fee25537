// What a pair of edge and face costs on a target, before any of them is computed.
#pragma once

#include "utd/interaction/edge_face_interaction.h"

namespace raytube {

/// Work of a pair (utd/wedge/work.h) at one frequency, as the target's longest edges show it: quadrature halves its panels wherever a
/// face begins or ends among the rays about an edge, and each of these rays is followed over all the faces it meets. It hangs on
/// the target and the wavenumber alone, comes in powers of two, and is right within a factor of ten (docs/theory/interaction.md).
double price_of_pair(const InteractionScene& scene, double wavenumber);

}  // namespace raytube
