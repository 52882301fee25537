// Results of several solves as those of one sweep.
#pragma once

#include <vector>

#include "scene/results.h"

namespace raytube {

/// The rows of all parts behind one another, what was counted added up. Parts have the same frequencies, and `looks` looks each.
SweepResult joined_results(std::vector<SweepResult> parts, std::size_t looks);

}  // namespace raytube
