// Blocks of cells of a launch grid, and the tiles that a grid is traced in.
#pragma once

#include <algorithm>
#include <cstdint>

#include "sbr/launch/convex_polygon.h"
#include "sbr/launch/launch.h"

namespace raytube {

/// Cells [column_begin, column_end) x [row_begin, row_end).
struct CellBlock {
  std::uint32_t column_begin, column_end, row_begin, row_end;
  std::uint64_t cells() const { return std::uint64_t{column_end - column_begin} * (row_end - row_begin); }
};

/// A cell in launch coordinates [m].
inline Bounds cell_bounds(const LaunchGrid& grid, std::uint32_t column, std::uint32_t row) {
  const dvec2 low{grid.u_begin + column * grid.du, grid.v_begin + row * grid.dv};
  return {low, low + dvec2(grid.du, grid.dv)};
}

/// The sides of a tile in cells: multiples of three, so that no group of the first coarse grid is divided (those of the second
/// are, at a tile's ends), and of the width of a packet of rays.
inline constexpr std::uint32_t tile_columns = 48, tile_rows = 45;

/// The tiles of a grid, numbered row by row; those at its far ends may be smaller.
class Tiling {
 public:
  /// Keeps a reference to `grid`.
  explicit Tiling(const LaunchGrid& grid) : grid_(grid), across_((grid.columns + tile_columns - 1) / tile_columns) {}

  std::size_t count() const { return std::size_t{across_} * ((grid_.rows + tile_rows - 1) / tile_rows); }

  CellBlock operator[](std::size_t index) const {
    const auto row = static_cast<std::uint32_t>(index / across_) * tile_rows,
               column = static_cast<std::uint32_t>(index % across_) * tile_columns;
    return {column, std::min(column + tile_columns, grid_.columns), row, std::min(row + tile_rows, grid_.rows)};
  }

 private:
  const LaunchGrid& grid_;
  std::uint32_t across_;
};

}  // namespace raytube
