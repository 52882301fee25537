// Tubes of polygonal cross-section, as wide as the faces they meet allow: cut at edges and shadow boundaries, nowhere else, as
// long as they are not both many and narrow.
//
// The central header of this folder, in which tubes on flat faces are traced in two ways: as polygons of launch coordinates,
// whose PO integral is a closed form whatever their size (polygon_tubes), or as single cells of the launch grid, each followed by
// one ray (tile_tracer, a tile of them where coverage finds the target). Bounces are counted from 0.
#pragma once

#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/visible/beam_visibility.h"

namespace raytube {

/// Follows the waves that reach the flat ones of the faces [begin, end) directly through all their reflections and integrates the
/// currents of every bounce. `visible` is of the look's faces and keeps its buffers from one call to the next.
TubeSums trace_faces(const TubeLook& look, BeamVisibility& visible, std::uint32_t begin, std::uint32_t end);

}  // namespace raytube
