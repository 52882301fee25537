#include "mesh/read/coordinate_step.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr int fewest_rounded_digits = 5;  // what has fewer was written by hand, and means what it says
constexpr int digits_of_single = 8;       // text that can tell neighbouring numbers of single precision apart
constexpr int bits_of_single = 23;        // behind the first one

}  // namespace

double coordinate_step(std::span<const dvec3> points, int digits) {
  double largest = 0.0;
  for (const dvec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (!(largest > 0.0 && std::isfinite(largest))) return 0.0;
  const bool rounded = digits >= fewest_rounded_digits;
  const double of_digits = rounded ? std::pow(10.0, std::floor(std::log10(largest)) + 1 - digits) : 0.0;
  if (digits > 0 && digits < digits_of_single) return of_digits;
  // Round numbers are numbers of single precision, too, but leave its last bits at 0.
  bool single = true, last_bits = false;
  for (const dvec3& p : points)
    for (int axis = 0; axis < 3 && single; ++axis) {
      const double nearest = static_cast<float>(p[axis]);
      single = std::abs(p[axis] - nearest) <= 0.5 * of_digits;
      last_bits |= nearest != 0.0 && std::fmod(nearest, std::ldexp(1.0, std::ilogb(nearest) - bits_of_single + 4)) != 0.0;
    }
  return std::max(of_digits, single && last_bits ? std::ldexp(1.0, std::ilogb(largest) - bits_of_single) : 0.0);
}

}  // namespace raytube
