#include "sbr/sbr.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "sbr/launch.h"

namespace raytube {

namespace {

// Tiles whose sums are held at a time: bounds memory however large the grid is.
constexpr std::size_t tiles_per_batch = 128;

std::vector<Tile> cut_into_tiles(const LaunchGrid& grid) {
  std::vector<Tile> tiles;
  for (std::uint32_t row = 0; row < grid.rows; row += tile_rows)
    for (std::uint32_t column = 0; column < grid.columns; column += tile_columns)
      tiles.push_back({column, std::min(column + tile_columns, grid.columns), row, std::min(row + tile_rows, grid.rows)});
  return tiles;
}

}  // namespace

TubeSums sbr_scattering(const Tracer& tracer, const Look& look, std::span<const double> frequencies, const TubeOptions& options,
                        Progress& progress, double share) {
  const SphericalBasis transmit = spherical_basis(look.transmit), receive = spherical_basis(look.receive);
  const double shortest = wavelength(*std::ranges::max_element(frequencies));
  const LaunchGrid grid = launch_grid(tracer.mesh(), look.transmit, shortest, options.per_wavelength, options.up);
  std::vector<double> wavenumbers(frequencies.size());
  std::ranges::transform(frequencies, wavenumbers.begin(), wavenumber);

  const std::vector<Tile> tiles = cut_into_tiles(grid);
  if (tiles.empty()) progress.add(share);
  TubeSums sums;
  for (std::size_t first = 0; first < tiles.size(); first += tiles_per_batch) {
    std::vector<TubeSums> batch(std::min(tiles_per_batch, tiles.size() - first));
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
      batch[i] = trace_tile(tracer, grid, tiles[first + i], transmit, receive, wavenumbers, options.max_bounces);
      progress.add(share / static_cast<double>(tiles.size()));
    });
    for (const TubeSums& tile : batch) sums.add(tile);
  }
  return sums;
}

}  // namespace raytube
