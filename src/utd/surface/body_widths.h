// How wide bodies are.
#pragma once

#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// The width of each component [m]: twice the largest distance of its points from the line through their mean and the farthest of
/// them. A spheroid has that of its lesser axis, a wing more than its chord.
std::vector<double> body_widths(const TriangleMesh& mesh);

/// What a body so wide, times the wavenumber, keeps of waves over it: all from 6 on, nothing below 4. There m = (width / 4)^(1/3)
/// is 1, and the transitions at its two shadow boundaries, 1/m to either side of each, leave a third of the half turn between
/// them: they are no longer Fock's, which know one boundary.
double share_of_width(double width);

}  // namespace raytube
