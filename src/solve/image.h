// The image of a look: from where on the target its S comes.
#pragma once

#include "scene/image.h"
#include "solve/solve.h"

namespace raytube {

/// The frequency images are made at: the middle one of the sweep's list.
std::size_t image_frequency(const Sweep& sweep);

/// The launch rectangle of a look in cells of `per_wavelength` to the wavelength, in the mesh's own coordinates. Throws
/// InputError if the look sees no area of the target, or for too many cells.
ImageLattice image_cells(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t look,
                         double per_wavelength);

/// S of that look, as solve() has it, by the cells from which it comes. What tubes give at any bounce is in the cell they set out
/// from. An edge, with all the currents that begin at it, is where it stands, also if light reaches it by reflection only; what
/// its waves paint on other surfaces is spread evenly over its lit piece. The same bytes for any number of threads. Throws
/// InputError as solve() does, and for EdgeMethod::utd, which has no currents.
LookImage image_of_look(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t look,
                        double per_wavelength);

}  // namespace raytube
