// What is known of a target whose sweep becomes profiles and images: how wide it is, and what is drawn over it.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "imaging/isar.h"
#include "plan/target.h"

namespace raytube {

/// Points of the target as wide as all of it, in its own coordinates.
std::vector<dvec3> outermost_of(const Target& target);

/// Its wedges, the longest, in its own coordinates.
std::vector<std::array<dvec3, 2>> lines_of(const Target& target);

/// The middle of the ranges in which the target lies, over all looks [m]; 0 where it is not known, without points. Throws
/// InputError that begins with `what` for one frequency, and for ranges that are more than the sweep shows without ambiguity.
double middle_range(const SweepSamples& samples, std::span<const dvec3> outermost, const std::string& what);

/// What an image shows: along its axes `asked`, else all of the target and no more than what is unambiguous, about its middle;
/// about the origin where it is not known. Throws InputError that begins with `what` for one frequency or angle, and for a target
/// or an image that is wider than what is unambiguous.
ImageFrame image_frame(const SweepSamples& samples, const AngleGrid& grid, const Window& window, std::span<const dvec3> outermost,
                       std::span<const double> asked, const std::string& what);

}  // namespace raytube
