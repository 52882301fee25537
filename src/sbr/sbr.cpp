#include "sbr/sbr.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "sbr/launch.h"

namespace raytube {

namespace {

// Tiles whose sums are held at a time: bounds memory however large the grid is.
constexpr std::size_t tiles_per_batch = 128;

// The tiles of a grid, numbered row by row.
struct Tiling {
  explicit Tiling(const LaunchGrid& launch)
      : grid(launch),
        across((launch.columns + tile_columns - 1) / tile_columns),
        count(std::size_t{across} * ((launch.rows + tile_rows - 1) / tile_rows)) {}

  Tile operator[](std::size_t index) const {
    const auto row = static_cast<std::uint32_t>(index / across) * tile_rows,
               column = static_cast<std::uint32_t>(index % across) * tile_columns;
    return {column, std::min(column + tile_columns, grid.columns), row, std::min(row + tile_rows, grid.rows)};
  }

  const LaunchGrid& grid;
  std::uint32_t across;
  std::size_t count;
};

}  // namespace

TubeSums sbr_scattering(const Tracer& tracer, const Look& look, std::span<const double> frequencies, const TubeOptions& options,
                        Progress& progress, double share) {
  const SphericalBasis transmit = spherical_basis(look.transmit), receive = spherical_basis(look.receive);
  const double shortest = wavelength(*std::ranges::max_element(frequencies));
  const LaunchGrid grid = launch_grid(tracer.mesh(), look.transmit, shortest, options.per_wavelength, options.up);
  std::vector<double> wavenumbers(frequencies.size());
  std::ranges::transform(frequencies, wavenumbers.begin(), wavenumber);

  const Tiling tiles(grid);
  if (tiles.count == 0) progress.add(share);
  TubeSums sums;
  for (std::size_t first = 0; first < tiles.count; first += tiles_per_batch) {
    std::vector<TubeSums> batch(std::min(tiles_per_batch, tiles.count - first));
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
      batch[i] = trace_tile(tracer, grid, tiles[first + i], transmit, receive, wavenumbers, options.max_bounces);
      progress.add(share / static_cast<double>(tiles.count));
    });
    for (const TubeSums& tile : batch) sums.add(tile);
  }
  return sums;
}

}  // namespace raytube
