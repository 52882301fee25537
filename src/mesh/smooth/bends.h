// Steep creases of coarse meshes that are no edges: there a curved surface bends as sharply as its facets can follow.
#pragma once

#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// The creases of at least `min_wedge_angle` [rad] that a smooth surface of the mesh's own resolution explains, in order of their
/// vertices. In the section across such a crease the surface turns the same way on both sides, by steps that, continued to the
/// crease, make up half of its angle and more; and on both sides they fall below `min_wedge_angle` before the surface is flat. So
/// rims beside flat or evenly curved faces are edges, and bars whose steps are all as steep.
std::vector<Bend> find_bends(const TriangleMesh& mesh, double min_wedge_angle);

}  // namespace raytube
