// Edges behind screens, from antennas at infinity.
#pragma once

#include <span>
#include <vector>

#include "utd/fringe/fringe_pieces.h"
#include "utd/fringe/screens.h"

namespace raytube {

/// fringe_scattering() where opaque surfaces cast shadows and screens do not. Parts of edges behind the same screens, for both
/// antennas, are taken together, and what they radiate is transformed by what these let through along both lines of sight. Valid
/// as T of the plane waves is: far from the screens' own edges. What a current starts at another edge has the screens of its own
/// edge, wherever that one is. The scene must have screens.
EdgeLookResult screened_fringe_scattering(const EdgeScene& scene, const Look& look, const SweepSubset& subset,
                                          const FringeOptions& options);

/// fringe_pieces() behind screens: of the currents of screened_fringe_scattering().
std::vector<ImageEdge> screened_fringe_pieces(const EdgeScene& scene, const Look& look, const SweepSubset& subset,
                                              const PieceRequest& request, const FringeOptions& options);

}  // namespace raytube
