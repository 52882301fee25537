#include "math/conic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

// The conic along one line: coordinate `axis` varies, the other one is `fixed`.
struct Section {
  double a, b, c;
};

Section section(const Conic& conic, int axis, double fixed) {
  const int other = 1 - axis;
  return {conic.m[axis][axis], conic.g[axis] + 2.0 * conic.m[0][1] * fixed,
          conic.c + (conic.g[other] + conic.m[other][other] * fixed) * fixed};
}

}  // namespace

// Without cancellation: the larger root first, the other from their product.
std::array<double, 2> quadratic_roots(double a, double b, double c) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0 || (a == 0.0 && b == 0.0)) return {nan, nan};
  const double sum = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  const double far = a == 0.0 ? std::copysign(infinity, -b) : sum / a, near = sum == 0.0 ? 0.0 : c / sum;
  return {std::min(far, near), std::max(far, near)};
}

Chord chord(const Conic& conic, int axis, double row, double low, double high) {
  const auto [a, b, c] = section(conic, axis, row);
  const auto [first, second] = quadratic_roots(a, b, c);
  if (std::isnan(first)) return c > 0.0 ? Chord{low, high} : Chord{};
  Chord part{low, high};
  if (a < 0.0)
    part = {std::max(first, low), std::min(second, high)};
  else if (0.0 < 0.5 * (first + second))
    part.high = std::min(first, high);
  else
    part.low = std::max(second, low);
  part.cut = part.low > low || part.high < high;
  return part.low < part.high ? part : Chord{};
}

std::vector<double> breaks(const Conic& conic, int axis, double low, double high, double row_low, double row_high) {
  std::vector<double> found;
  const auto add = [&](const std::array<double, 2>& rows) {
    for (const double row : rows)
      if (row > row_low && row < row_high) found.push_back(row);
  };
  for (const double end : {low, high}) {
    const auto [a, b, c] = section(conic, 1 - axis, end);
    add(quadratic_roots(a, b, c));
  }
  // The discriminant of section(row), as a quadratic of the row.
  const int other = 1 - axis;
  const double a = conic.m[axis][axis], mixed = 2.0 * conic.m[0][1];
  add(quadratic_roots(mixed * mixed - 4.0 * a * conic.m[other][other], 2.0 * mixed * conic.g[axis] - 4.0 * a * conic.g[other],
                      conic.g[axis] * conic.g[axis] - 4.0 * a * conic.c));
  std::ranges::sort(found);
  return found;
}

}  // namespace raytube
