// What is known of a target whose sweep becomes profiles and images: how wide it is, and what is drawn over it.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "imaging/sweep_grid.h"
#include "imaging/window.h"
#include "plan/target.h"

namespace raytube {

/// Points of the target as wide as all of it, in its own coordinates.
std::vector<dvec3> outermost_of(const Target& target);

/// Its wedges, the longest, in its own coordinates.
std::vector<std::array<dvec3, 2>> lines_of(const Target& target);

/// Throws InputError that begins with `what` for one frequency, and for a target that is deeper than what the sweep shows
/// without ambiguity. No points: the target is not known.
void require_range(const SweepSamples& samples, std::span<const dvec3> outermost, const std::string& what);

/// What an image shows along its axes [m]: `asked`, else all of the target and no more than what is unambiguous. Throws
/// InputError that begins with `what` for one frequency or angle, and for a target that is wider than that.
std::array<double, 3> image_size(const SweepSamples& samples, const AngleGrid& grid, const Window& window,
                                 std::span<const dvec3> outermost, std::span<const double> asked, const std::string& what);

}  // namespace raytube
