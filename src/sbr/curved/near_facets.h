// Curved surfaces of a convex body near the antennas, facet by facet.
#pragma once

#include <cstdint>

#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"

namespace raytube {

/// What the antennas of a look excite on curved surfaces over the facets [begin, end); each that is lit counts as a tube.
TubeSums light_curved_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end);

}  // namespace raytube
