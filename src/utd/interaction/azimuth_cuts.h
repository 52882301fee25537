// Where the waves about an edge may jump or bend.
#pragma once

#include <vector>

#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// Ascending azimuths [rad] from one face of the edge to the other, both included: shadow and reflection boundaries, corners, and
/// where there are few corners and patches the corners' mirror images and where rays run along a patch; between them more, so
/// that no two lie far apart.
/// Where `wanted` is not empty only those between the first and the last azimuth it reaches matter; others may be missing.
std::vector<double> azimuth_cuts(const TriangleMesh& mesh, std::span<const dvec3> corners, const LitEdgePiece& source,
                                 std::span<const AzimuthRange> wanted = {});

}  // namespace raytube
