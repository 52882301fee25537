// Where rounding would decide, and not physics.
#pragma once

#include <algorithm>
#include <cmath>

namespace raytube {

/// Sines, cosines, counts of parts, and lengths over that of an edge or over the target's radius are equal if they differ by
/// less. Double precision has 1e-16 of them; hundreds of operations, and a mesh far from its origin, leave no more than 1e-10.
inline constexpr double rounding_guard = 1e-9;
/// Such numbers are equal, if they differ by less, where they come from the same inputs by a few operations.
inline constexpr double tie_guard = 1e-12;

/// Into how many equal parts something is cut that is `ratio` times as large as a part may be.
inline double part_count(double ratio) { return std::max(1.0, std::ceil(ratio - rounding_guard)); }

}  // namespace raytube
