// Coplanar triangles in patches.
#pragma once

#include <span>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// Groups triangles that are connected within a component and lie in one plane within `distance`; fills `patches` and
/// `triangle_patch` of the mesh. Vertices that are off the planes of their patches by no more than the file's rounding are put
/// on them, where they would lie without it: so edges lie in faces, and faces of several triangles are plane. `materials` of each
/// triangle, or empty if all are perfect conductors, cut the patches found so: pieces keep their plane, so that the shape of a
/// target does not depend on what it is made of.
void find_patches(TriangleMesh& mesh, double distance, std::span<const std::uint32_t> materials = {});

}  // namespace raytube
