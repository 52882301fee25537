// The edges of a target that may light other surfaces.
#pragma once

#include <vector>

#include "mesh/model/face_tree.h"
#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// Weight of a wave on a wedge: that of its incidence, 0 along the edge (sine below 1e-4). Light that comes over the sheet whose
/// rim it lights counts from 0 in the sheet's plane, on whose other side the rim does the opposite, to 1 at a degree from it.
double light_weight(const Wedge& wedge, const WedgeIncidence& incidence);

/// Axes of the convex wedges that see anything of the mesh but their own faces, in the order of the wedges; none on a convex
/// body. They point into `wedges`.
std::vector<EdgeAxis> edge_axes(const TriangleMesh& mesh, std::span<const Wedge> wedges);

}  // namespace raytube
