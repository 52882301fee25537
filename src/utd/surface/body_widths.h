// How wide bodies are.
#pragma once

#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// Of each component: twice the largest distance of its points from the line through their mean and the farthest of them [m]. Of
/// a spheroid its lesser axis, of a wing more than its chord.
std::vector<double> body_widths(const TriangleMesh& mesh);

}  // namespace raytube
