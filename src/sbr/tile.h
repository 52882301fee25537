// One tile of the launch grid, traced and integrated by one thread.
#pragma once

#include <span>

#include "sbr/launch.h"
#include "sbr/tube_sums.h"

namespace raytube {

/// A block of cells [column_begin, column_end) x [row_begin, row_end) of a launch grid.
struct Tile {
  std::uint32_t column_begin, column_end, row_begin, row_end;
};

inline constexpr std::uint32_t tile_columns = 128, tile_rows = 16;

/// Traces every tube of the tile through up to `max_bounces` reflections and integrates the currents of every bounce.
TubeSums trace_tile(const Tracer& tracer, const LaunchGrid& grid, const Tile& tile, const SphericalBasis& transmit,
                    const SphericalBasis& receive, std::span<const double> wavenumbers, int max_bounces);

}  // namespace raytube
