// The pieces of a look, each with the place that it scatters from.
#pragma once

#include "plan/target.h"
#include "scene/scattering_piece.h"
#include "scene/sweep.h"

namespace raytube {

/// Tells the sink everything that adds to S of one monostatic look at one frequency [Hz], in pieces of at most `cell` [m] across
/// and in depth (but for steep surfaces, whose slices are thin or many): their sum is S as solve() has it. Places and phases
/// count from the origin of the mesh's own coordinates. Throws InputError as image_of_look does; Interrupted when `progress` says
/// stop. Over a ground, which is perfect, what gets to the target or from it by way of the ground is at the height of it,
/// half-way between target and mirror image, with all that edges begin; the target has its mirror image with it.
void scattering_pieces(const Target& target, const Sweep& sweep, std::size_t look, double frequency, const SolveOptions& options,
                       double cell, const PieceSink& sink, const std::optional<Ground>& ground = {});

}  // namespace raytube
