#include "sbr/launch/lattice.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// Rays with index in [first_at_or_after(low), first_at_or_after(high)) lie in [low, high).
std::uint32_t first_at_or_after(double at, double first_ray, double step, std::uint32_t count) {
  const double index = std::ceil((at - first_ray) / step);
  return static_cast<std::uint32_t>(std::clamp(index, 0.0, static_cast<double>(count)));
}

// Where the polygon's outline crosses the line of a row; two polygons find the same point on the edge they share.
Range crossings(const ConvexPolygon& polygon, double v) {
  Range across{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    dvec2 p = polygon[i].at, q = polygon[(i + 1) % polygon.size()].at;
    if ((p.y <= v) == (q.y <= v)) continue;
    if (p.y > q.y) std::swap(p, q);
    const double u = p.x + (v - p.y) / (q.y - p.y) * (q.x - p.x);
    across.low = std::min(across.low, u);
    across.high = std::max(across.high, u);
  }
  return across;
}

}  // namespace

void cells_under(const LaunchGrid& grid, const ConvexPolygon& polygon, std::vector<CellBlock>& blocks) {
  blocks.clear();
  const dvec2 first = grid.ray_coordinates(0, 0);
  const Bounds box = bounds(polygon);
  const std::uint32_t row_end = first_at_or_after(box.high.y, first.y, grid.dv, grid.rows);
  for (std::uint32_t row = first_at_or_after(box.low.y, first.y, grid.dv, grid.rows); row < row_end; ++row) {
    const Range across = crossings(polygon, first.y + row * grid.dv);
    if (!(across.low < across.high)) continue;
    const std::uint32_t begin = first_at_or_after(across.low, first.x, grid.du, grid.columns),
                        end = first_at_or_after(across.high, first.x, grid.du, grid.columns);
    if (begin == end) continue;
    if (!blocks.empty() && blocks.back().row_end == row && blocks.back().column_begin == begin && blocks.back().column_end == end)
      ++blocks.back().row_end;
    else
      blocks.push_back({begin, end, row, row + 1});
  }
}

}  // namespace raytube
