#include "scene/image.h"

#include <algorithm>

namespace raytube {

namespace {

std::uint32_t cell_along(double at, double corner, double cell, std::uint32_t count) {
  return static_cast<std::uint32_t>(std::clamp(std::floor((at - corner) / cell), 0.0, count - 1.0));
}

// Appends where a way from `a` to `b` crosses the lines corner + i cell, 0 < i < count.
void add_crossings(double a, double b, double corner, double cell, std::uint32_t count, std::vector<double>& shares) {
  const std::uint32_t first = cell_along(std::min(a, b), corner, cell, count),
                      last = cell_along(std::max(a, b), corner, cell, count);
  for (std::uint32_t line = first + 1; line <= last; ++line) {
    const double share = (corner + line * cell - a) / (b - a);
    if (share > 0.0 && share < 1.0) shares.push_back(share);
  }
}

}  // namespace

glm::uvec2 ImageLattice::at(const dvec2& point) const {
  return {cell_along(point.x, corner.x, cell.x, columns), cell_along(point.y, corner.y, cell.y, rows)};
}

std::vector<double> ImageLattice::crossings(const dvec3& begin, const dvec3& end) const {
  const dvec2 a = project(begin), b = project(end);
  std::vector<double> shares{0.0, 1.0};
  add_crossings(a.x, b.x, corner.x, cell.x, columns, shares);
  add_crossings(a.y, b.y, corner.y, cell.y, rows, shares);
  if (curvature != 0.0) {
    const double near_begin = widening(begin - middle_of_target), near_end = widening(end - middle_of_target);
    for (double& share : shares) share = share * near_begin / (share * near_begin + (1.0 - share) * near_end);
  }
  std::ranges::sort(shares);
  return shares;
}

}  // namespace raytube
