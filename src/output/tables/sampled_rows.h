// Which sweeps of a case are too coarse for its target's lobes.
#pragma once

#include <span>
#include <vector>

#include "output/tables/cuts.h"

namespace raytube {

/// Steps of a swept quantity that are too wide, and the widest that would do [degrees or GHz]: of angles for lobes, of frequency
/// for a range profile.
struct CoarseSteps {
  RowCoordinates::Quantity quantity;
  double step, limit;
};

/// One for each swept quantity whose steps are too wide somewhere: a sweep is four values or more in even steps, with all other
/// quantities held fixed; single directions and lists are none.
std::vector<CoarseSteps> coarse_steps(const Sweep& sweep, std::span<const dvec3> outermost);

/// Whether ascending values are in even steps, to the few digits that a list may be written with.
bool in_even_steps(std::span<const double> x);

/// Whether the rows, in this order, are close enough to be joined by a line; so are those of a target not known, without points.
bool can_be_joined(const Sweep& sweep, std::span<const dvec3> outermost, std::span<const std::size_t> rows);

}  // namespace raytube
