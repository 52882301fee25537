#include "sbr/flat/tile.h"

#include <utility>

#include "sbr/flat/coverage.h"

namespace raytube {

namespace {

dvec2 middle(const LaunchGrid& grid, const Tile& tile) {
  return {0.5 * (grid.u_center(tile.column_begin) + grid.u_center(tile.column_end - 1)),
          0.5 * (grid.v_center(tile.row_begin) + grid.v_center(tile.row_end - 1))};
}

}  // namespace

TubeSums TileTracer::trace(const Tile& tile) {
  sums_ = {};
  sums_.tubes = std::uint64_t{tile.row_end - tile.row_begin} * (tile.column_end - tile.column_begin);
  beams_.restart(incident_beam(grid_, transmit_, middle(grid_, tile)));
  tubes_.sample_coarse_grids({tile.column_begin, tile.column_end, tile.row_begin, tile.row_end});
  launch(tile);
  if (not_traced_.reflected_tubes) {
    tubes_.advance(0, max_bounces_);
    tubes_.clear();
  }
  for (int bounce = 0; !tubes_.empty(); ++bounce) {
    beams_.next_bounce();
    tubes_.advance(bounce, max_bounces_);
  }
  sums_.compare_with(tubes_.coarse_sums());
  return std::move(sums_);
}

void TileTracer::launch(const Tile& tile) {
  const Coverage coverage(not_traced_.faces, grid_, tile);
  sums_.empty_cells = coverage.empty_cells();
  for (std::uint32_t row = tile.row_begin; row < tile.row_end; ++row)
    for (auto span = coverage.next(row, tile.column_begin); span.begin < span.end; span = coverage.next(row, span.end))
      tubes_.launch(row, span.begin, span.end);
}

}  // namespace raytube
