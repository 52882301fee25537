// Coplanar triangles in patches.
#pragma once

#include "mesh/triangle_mesh.h"

namespace raytube {

/// Groups triangles that are connected within a component and lie in one plane within `distance`; fills `patches` and
/// `triangle_patch` of the mesh.
void find_patches(TriangleMesh& mesh, double distance);

}  // namespace raytube
