// Bodies that are filled with a medium.
#pragma once

#include <span>

#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"

namespace raytube {

/// Throws InputError for a solid that does not fill a closed body of its own, and for bodies inside of one that are neither
/// conductors nor absorbers.
void check_solids(const TriangleMesh& mesh, std::span<const Material> materials);

}  // namespace raytube
