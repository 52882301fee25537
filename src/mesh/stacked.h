// Surfaces that lie on one another, or almost.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace raytube {

/// For each triangle, whether another one of a different patch overlaps it at less than `distance` [m] in front or behind,
/// almost parallel: single precision cannot tell which of the two a ray meets first.
std::vector<bool> find_stacked_triangles(const TriangleMesh& mesh, double distance);

}  // namespace raytube
