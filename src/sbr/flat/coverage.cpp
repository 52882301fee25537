#include "sbr/flat/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

// A face takes as long to fill in as about so many cells take to trace.
constexpr std::size_t cells_per_face = 8;
// Times the radius; far above the rounding of a projection, far below a cell.
constexpr double margin = 1e-9;

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// The indices i in [begin, end) for which first + i * step lies from `low` to `high`, both included.
struct Indices {
  Indices(double low, double high, double first, double step, std::uint32_t begin, std::uint32_t end)
      : from(clamped(std::ceil((low - first) / step), begin, end)),
        to(clamped(std::floor((high - first) / step) + 1.0, begin, end)) {}
  static std::uint32_t clamped(double index, std::uint32_t begin, std::uint32_t end) {
    return static_cast<std::uint32_t>(std::clamp(index, double(begin), double(end)));
  }
  std::uint32_t from, to;
};

// What a convex polygon covers of the band low <= y <= high.
Interval across_band(std::span<const dvec2> corners, double low, double high) {
  Interval across;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    dvec2 p = corners[i], q = corners[(i + 1) % corners.size()];
    if (p.y > q.y) std::swap(p, q);
    if (q.y < low || p.y > high) continue;
    const auto at = [&](double y) { return y <= p.y ? p.x : y >= q.y ? q.x : p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x); };
    across.include(at(low));
    across.include(at(high));
  }
  return across;
}

}  // namespace

Coverage::Coverage(const FaceTree* faces, const LaunchGrid& grid, const CellBlock& tile)
    : grid_(grid),
      tile_(tile),
      beam_(incident_beam(grid, {}, dvec2(0.0))),
      margin_(faces ? margin * faces->mesh().radius : 0.0),
      cells_(std::size_t{tile.row_end - tile.row_begin} * (tile.column_end - tile.column_begin), faces ? 0 : 1) {
  if (!faces) return;
  const dvec2 low{grid.u_begin + tile.column_begin * grid.du, grid.v_begin + tile.row_begin * grid.dv},
      high{grid.u_begin + tile.column_end * grid.du, grid.v_begin + tile.row_end * grid.dv};
  const std::size_t most_faces = cells_.size() / cells_per_face;
  std::vector<std::uint32_t> found;
  faces->collect(prism_of(beam_, nullptr, {low, high}, nullptr, std::numeric_limits<double>::infinity(), faces->mesh().radius),
                 found, most_faces);
  if (found.size() > most_faces) {
    std::ranges::fill(cells_, 1);
    return;
  }
  for (const std::uint32_t face : found) mark(*faces, face);
}

Coverage::Span Coverage::next(std::uint32_t row, std::uint32_t column) const {
  const auto at = [&](std::uint32_t c) { return cells_.begin() + static_cast<std::ptrdiff_t>(index(c, row)); };
  const auto end_of_row = at(tile_.column_end), begin = std::find(at(column), end_of_row, 1),
             end = std::find(begin, end_of_row, 0);
  return {tile_.column_end - static_cast<std::uint32_t>(end_of_row - begin),
          tile_.column_end - static_cast<std::uint32_t>(end_of_row - end)};
}

void Coverage::mark(const FaceTree& faces, std::uint32_t face) {
  corners_.clear();
  Interval rows;
  for (const std::uint32_t corner : faces.corners(face)) {
    corners_.push_back(launch_coordinates(beam_, faces.mesh().vertices[corner]));
    rows.include(corners_.back().y);
  }
  const double first = grid_.ray_coordinates(0, 0).y;
  const Indices indices(rows.low - margin_, rows.high + margin_, first, grid_.dv, tile_.row_begin, tile_.row_end);
  for (std::uint32_t row = indices.from; row < indices.to; ++row) {
    const double v = first + row * grid_.dv;
    const Interval across = across_band(corners_, v - margin_, v + margin_);
    if (across.low <= across.high) mark_row(row, across.low, across.high);
  }
}

void Coverage::mark_row(std::uint32_t row, double low, double high) {
  const Indices indices(low - margin_, high + margin_, grid_.ray_coordinates(0, 0).x, grid_.du, tile_.column_begin,
                        tile_.column_end);
  if (indices.from < indices.to)
    std::fill_n(cells_.begin() + static_cast<std::ptrdiff_t>(index(indices.from, row)), indices.to - indices.from, 1);
}

}  // namespace raytube
