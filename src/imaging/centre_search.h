// Where a look scatters from most: CLEAN (Hogbom, Astron. Astrophys. Suppl. 15 (1974), 417).
#pragma once

#include <vector>

#include "imaging/piece_clusters.h"

namespace raytube {

/// So many places at most, the strongest first, in the axes of the look: of the largest response of all four channels together,
/// less what the places before took off. Throws InputError for more cells than can be held.
std::vector<dvec3> centre_places(const std::vector<PieceCluster>& clusters, double side, std::size_t count);

}  // namespace raytube
