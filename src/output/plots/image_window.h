// What of an image is left when neighbouring cells interfere.
#pragma once

#include "scene/image.h"

namespace raytube {

/// Every cell replaced by the coherent sum of those about it, with the weight cos^2(pi x / width) cos^2(pi y / width) of a Hann
/// window of this full width [m] (Blackman and Tukey 1958). Currents whose phase turns by two full turns and more across the
/// window cancel, as they do in S; what stays is what returns: specular spots, corners, edges. Cells that hold nothing stay
/// empty, so that the target's outline shows.
std::vector<ScatteringMatrix> seen_through_window(const ImageLattice& lattice, std::vector<ScatteringMatrix> cells, double width);

}  // namespace raytube
