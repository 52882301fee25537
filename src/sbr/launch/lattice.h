// The uniform grid's cells under a polygon of the launch plane.
#pragma once

#include <vector>

#include "sbr/launch/convex_polygon.h"
#include "sbr/launch/launch.h"

namespace raytube {

/// Cells [column_begin, column_end) x [row_begin, row_end).
struct CellBlock {
  std::uint32_t column_begin, column_end, row_begin, row_end;
  std::uint64_t cells() const { return std::uint64_t{column_end - column_begin} * (row_end - row_begin); }
};

inline Bounds cell_bounds(const LaunchGrid& grid, std::uint32_t column, std::uint32_t row) {
  const dvec2 low{grid.u_begin + column * grid.du, grid.v_begin + row * grid.dv};
  return {low, low + dvec2(grid.du, grid.dv)};
}

/// Fills `blocks` with the cells of the grid whose ray runs through the polygon. Rows that share their columns are one block.
/// Polygons that share an edge share no cell and leave none out.
void cells_under(const LaunchGrid& grid, const ConvexPolygon& polygon, std::vector<CellBlock>& blocks);

}  // namespace raytube
