// The edges of a target that may light other surfaces.
#pragma once

#include <vector>

#include "mesh/face_tree.h"
#include "utd/edge_painter.h"

namespace raytube {

/// Weight of light that comes over the sheet whose rim it lights: from 0 in the sheet's plane, on whose other side the rim does
/// the opposite, to 1 at a degree from it. 1 at other edges.
double glancing_weight(const Wedge& wedge, const FaceIncidence& incidence);

/// Axes of the convex wedges that see anything of the mesh but their own faces, in the order of the wedges; none on a convex
/// body. They point into `wedges`.
std::vector<EdgeAxis> edge_axes(const TriangleMesh& mesh, std::span<const Wedge> wedges);

}  // namespace raytube
