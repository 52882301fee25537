// Triangles that lie on one another.
#pragma once

#include <span>

#include "mesh/model/triangle_mesh.h"
#include "mesh/repair/facets.h"

namespace raytube {

/// Keeps one of several triangles with the same corners and winding. Triangles with the same corners and opposite windings
/// are either the wall where two closed bodies touch, and both go, or an open surface drawn from both sides, and one stays. A
/// wall that waves reach through what is around it is no such wall. The first one stays, whatever the others are made of. Fills
/// triangles_duplicate, duplicates_of_other_material and triangles_internal of the report.
void drop_duplicates(Facets& facets, std::span<const Material> materials, std::size_t vertex_count, MeshReport& report);

}  // namespace raytube
