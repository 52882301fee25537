// One tile of the launch grid, traced and integrated by one thread.
#pragma once

#include <span>

#include "mesh/smooth.h"
#include "sbr/launch.h"
#include "sbr/tube_sums.h"

namespace raytube {

/// A block of cells [column_begin, column_end) x [row_begin, row_end) of a launch grid.
struct Tile {
  std::uint32_t column_begin, column_end, row_begin, row_end;
};

// Multiples of three, so that no group of the coarse grid is cut, and of the packet's width.
inline constexpr std::uint32_t tile_columns = 144, tile_rows = 15;

/// Traces every tube of the tile through up to `max_bounces` reflections and integrates the currents of every bounce, over the
/// cells and over those of a grid three times as coarse; with `smooth` only those that meet a flat surface first. The tile begins
/// at a column and a row divisible by three.
TubeSums trace_tile(const Tracer& tracer, const LaunchGrid& grid, const Tile& tile, const SphericalBasis& transmit,
                    const SphericalBasis& receive, std::span<const double> wavenumbers, int max_bounces,
                    const SmoothSurfaces* smooth);

}  // namespace raytube
