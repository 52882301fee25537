// Symmetry of a target about the planes through the middle of its bounding box.
#pragma once

#include <array>
#include <span>

#include "mesh/features/wedges.h"

namespace raytube {

/// For each axis, whether the target is its own image across the plane x = 0, y = 0 or z = 0 of recentred coordinates, to
/// rounding. Patches, their materials and their outlines are compared: how a face is cut into triangles matters only if `facets`
/// are to be images as well. So are the wedges: where creases are just as sharp as the limit of what counts as one, rounding
/// decides, and not always alike.
std::array<bool, 3> find_symmetry_planes(const TriangleMesh& mesh, std::span<const Wedge> wedges, bool facets = false);

}  // namespace raytube
