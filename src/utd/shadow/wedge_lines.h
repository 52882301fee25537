// Every wedge of a target, with the share of it that one transmitter lights.
#pragma once

#include <span>
#include <vector>

#include "mesh/features/wedges.h"
#include "scene/sweep.h"
#include "scene/wedge_line.h"

namespace raytube {

/// The wedges for which no half plane stands, in their order. Lit: by the transmitter of the look; a wedge that is turned away or
/// concave, and so plays no part, is dark. `wavelength` [m] is the shortest one.
std::vector<WedgeLine> wedge_lines(const TriangleMesh& mesh, std::span<const Wedge> wedges, const Look& look, double wavelength);

}  // namespace raytube
