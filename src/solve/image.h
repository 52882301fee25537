// The image of a look: from where on the target its S comes.
#pragma once

#include "plan/plan.h"
#include "scene/image.h"

namespace raytube {

/// The frequency images are made at: the middle one of the sweep's list.
std::size_t image_frequency(const Sweep& sweep);

/// The launch rectangle of a look in cells of `per_wavelength` to the wavelength, in the mesh's own coordinates. Over a medium it
/// takes in the mirror image of the target, too. Throws InputError if the look sees no area of the target, or for too many cells.
ImageLattice image_cells(const SolvePlan& plan, std::size_t look, double per_wavelength);

/// S of that look, as solve() has it, by the cells from which it comes. What tubes give at any bounce is in the cell they set out
/// from. An edge, with all the currents that begin at it, is where it stands, also if light reaches it by reflection only; what
/// its waves excite on other faces is spread evenly over its lit piece. Over ground: what the ground lights or reflects is where
/// the mirror image is seen. The same bytes for any number of threads. `progress` as for solve(). Throws InputError for rays in
/// the place of currents, and as image_cells does; Interrupted when `progress` says stop.
LookImage image_of_look(const SolvePlan& plan, std::size_t look, double per_wavelength,
                        const std::function<bool(double)>& progress = {});

/// Plans first; throws InputError as SolvePlan does, too.
LookImage image_of_look(const Target& target, const Sweep& sweep, const SolveOptions& options, std::size_t look,
                        double per_wavelength);

}  // namespace raytube
