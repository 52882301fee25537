// Where the waves about an edge may jump or bend.
#pragma once

#include <vector>

#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// Azimuths of corners and of images end panels up to so many of either: beyond them what
/// cuts cost would go with the square of the faces.
inline constexpr std::size_t most_cuts = 200;

/// Ascending azimuths [rad] from one face of the edge to the other, both included: shadow and reflection boundaries, corners, and
/// where there are few corners and patches the corners' mirror images and where rays run along a patch; between them more, so
/// that no two lie far apart.
/// Where `wanted` is not empty only those between the first and the last azimuth it reaches matter; others may be missing.
std::vector<double> azimuth_cuts(const TriangleMesh& mesh, std::span<const dvec3> corners, const LitEdgePiece& source,
                                 std::span<const AzimuthRange> wanted = {});

}  // namespace raytube
