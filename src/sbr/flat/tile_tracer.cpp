#include "sbr/flat/tile_tracer.h"

#include <utility>

#include "sbr/flat/coverage.h"

namespace raytube {

namespace {

dvec2 middle(const LaunchGrid& grid, const CellBlock& tile) {
  return {0.5 * (grid.u_center(tile.column_begin) + grid.u_center(tile.column_end - 1)),
          0.5 * (grid.v_center(tile.row_begin) + grid.v_center(tile.row_end - 1))};
}

}  // namespace

TubeSums TileTracer::trace(const CellBlock& tile) {
  sums_ = {};
  sums_.tubes = tile.cells();
  beams_.restart(incident_beam(look_.grid, look_.transmit, middle(look_.grid, tile)));
  tubes_.sample_coarse_grids(tile);
  launch(tile);
  if (look_.convexity.no_reflection) {
    tubes_.advance(0);
    tubes_.clear();
  }
  for (int bounce = 0; !tubes_.empty(); ++bounce) {
    beams_.next_bounce();
    tubes_.advance(bounce);
  }
  sums_.compare_with(tubes_.coarse_sums());
  return std::move(sums_);
}

void TileTracer::launch(const CellBlock& tile) {
  const Coverage coverage(look_.skip ? &look_.faces : nullptr, look_.grid, tile);
  sums_.empty_cells = coverage.empty_cells();
  for (std::uint32_t row = tile.row_begin; row < tile.row_end; ++row)
    for (auto span = coverage.next(row, tile.column_begin); span.begin < span.end; span = coverage.next(row, span.end))
      tubes_.launch(row, span.begin, span.end);
}

}  // namespace raytube
