#include "mesh/read/coordinate_step.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr int fewest_rounded_digits = 5;  // what has fewer was written by hand, and means what it says
constexpr int digits_of_single = 8;       // text that can tell neighbouring numbers of single precision apart
constexpr int bits_of_single = 23;        // behind the first one

constexpr double beyond_single = 1e38;  // such files are refused

double single_step(double x) { return std::ldexp(1.0, std::ilogb(x) - bits_of_single); }

}  // namespace

double coordinate_step(std::span<const dvec3> points, int digits) {
  dvec3 largest(0.0);  // along each axis
  for (const dvec3& p : points)
    for (int axis = 0; axis < 3; ++axis)
      largest[axis] = std::isfinite(p[axis]) ? std::max(largest[axis], std::abs(p[axis])) : beyond_single;
  const double farthest = std::max({largest.x, largest.y, largest.z});
  if (farthest == 0.0 || farthest >= beyond_single) return 0.0;
  const double of_digits = digits < fewest_rounded_digits ? 0.0 : std::pow(10.0, std::floor(std::log10(farthest)) + 1 - digits);
  if (digits > 0 && digits < digits_of_single) return of_digits;
  // Round numbers are numbers of single precision, too, but leave its last bits at 0.
  double step = of_digits;
  for (const dvec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      const double nearest = static_cast<float>(p[axis]);
      if (std::abs(p[axis] - nearest) > 0.5 * of_digits) return of_digits;
      const bool is_large = nearest != 0.0 && 2.0 * std::abs(nearest) > largest[axis];
      if (is_large && std::fmod(nearest, 16.0 * single_step(nearest)) != 0.0) step = std::max(step, single_step(largest[axis]));
    }
  return step;
}

}  // namespace raytube
