// Bodies that are filled with a medium.
#pragma once

#include <span>

#include "mesh/model/face_tree.h"
#include "scene/material.h"

namespace raytube {

/// Throws InputError for a solid that does not fill a closed body of its own, for bodies that touch one or run through it, and
/// for bodies inside of one that are neither conductors nor absorbers.
void check_solids(const FaceTree& faces, std::span<const Material> materials);

}  // namespace raytube
