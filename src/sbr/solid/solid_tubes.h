// Tubes that have been inside of solid bodies: triangles of the launch plane whose three rays meet the same surfaces, divided
// where they do not. What surfaces reflect without any wave having been inside is traced as of half-spaces, elsewhere.
#pragma once

#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"

namespace raytube {

/// The currents outside of solids, of the waves that leave them and of what these meet, of tubes that meet one of the triangles
/// [begin, end) first. Narrow tubes that an edge would divide are no wider than a cell of the grid. Of looks from afar.
TubeSums trace_solids(const TubeLook& look, std::uint32_t begin, std::uint32_t end);

}  // namespace raytube
