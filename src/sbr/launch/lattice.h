// The cells of a launch grid under a polygon of the launch plane.
#pragma once

#include <vector>

#include "sbr/launch/convex_polygon.h"
#include "sbr/launch/launch.h"
#include "sbr/launch/tile.h"

namespace raytube {

/// A cell in launch coordinates [m].
inline Bounds cell_bounds(const LaunchGrid& grid, std::uint32_t column, std::uint32_t row) {
  const dvec2 low{grid.u_begin + column * grid.du, grid.v_begin + row * grid.dv};
  return {low, low + dvec2(grid.du, grid.dv)};
}

/// Fills `blocks` with the cells of the grid whose ray runs through the polygon. Rows that share their columns are one block.
/// Polygons that share an edge share no cell and leave none out.
void cells_under(const LaunchGrid& grid, const ConvexPolygon& polygon, std::vector<CellBlock>& blocks);

}  // namespace raytube
