// Triangles that lie on one another.
#pragma once

#include <vector>

#include "mesh/geometry.h"
#include "mesh/triangle_mesh.h"

namespace raytube {

/// Keeps one of several triangles with the same corners and winding. Triangles with the same corners and opposite windings
/// are either the wall where two closed bodies touch, and both go, or a sheet drawn from both sides, and one stays.
/// Fills triangles_duplicate and triangles_internal of the report.
void drop_duplicates(std::vector<Triangle>& triangles, std::size_t vertex_count, MeshReport& report);

}  // namespace raytube
