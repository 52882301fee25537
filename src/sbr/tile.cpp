#include "sbr/tile.h"

#include "sbr/cell_tubes.h"

namespace raytube {

namespace {

dvec2 middle(const LaunchGrid& grid, const Tile& tile) {
  return {0.5 * (grid.u_center(tile.column_begin) + grid.u_center(tile.column_end - 1)),
          0.5 * (grid.v_center(tile.row_begin) + grid.v_center(tile.row_end - 1))};
}

}  // namespace

TubeSums trace_tile(const Tracer& tracer, const LaunchGrid& grid, const Tile& tile, const SphericalBasis& transmit,
                    const SphericalBasis& receive, std::span<const double> wavenumbers, int max_bounces,
                    const SmoothSurfaces* smooth) {
  TubeSums sums;
  BeamTree beams(tracer.mesh(), receive, incident_beam(grid, transmit, middle(grid, tile)));
  CellTubes tubes(tracer, grid, wavenumbers, beams, sums);
  sums.tubes = std::uint64_t{tile.row_end - tile.row_begin} * (tile.column_end - tile.column_begin);
  tubes.reserve(sums.tubes);
  tubes.sample_coarse_grid();
  tubes.leave_out(smooth);
  for (std::uint32_t row = tile.row_begin; row < tile.row_end; ++row)
    for (std::uint32_t column = tile.column_begin; column < tile.column_end; ++column) tubes.launch(column, row);
  for (int bounce = 0; !tubes.empty(); ++bounce) tubes.advance(bounce, max_bounces);
  sums.compare_with(tubes.coarse_sums());
  return sums;
}

}  // namespace raytube
