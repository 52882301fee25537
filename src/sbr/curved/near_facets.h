// Curved surfaces near the antennas, facet by facet.
#pragma once

#include <cstdint>

#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"

namespace raytube {

/// What the antennas of a look excite on the curved surfaces of a convex body over the triangles [begin, end), wherever these
/// surfaces face the transmitter; each triangle that is lit counts as a tube.
TubeSums light_convex_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end);

/// What they excite on the curved surfaces of any body over the faces [begin, end), where the transmitter sees the facets.
TubeSums light_visible_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end);

}  // namespace raytube
