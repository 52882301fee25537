#include "sbr/sbr.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "sbr/adaptive.h"
#include "sbr/curved_cells.h"
#include "sbr/curved_tubes.h"
#include "sbr/launch.h"
#include "sbr/tile.h"

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

// Faces whose tubes are followed together.
constexpr std::uint32_t faces_per_tile = 256;

// Adds up tile(0) ... tile(count - 1) in this order, whoever computes them.
template <class Function>
TubeSums sum_tiles(std::size_t count, Function tile, Progress& progress, double share) {
  if (count == 0) progress.add(share);
  TubeSums sums;
  for (std::size_t first = 0; first < count; first += tiles_per_batch) {
    std::vector<TubeSums> batch(std::min(tiles_per_batch, count - first));
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
      batch[i] = tile(first + i);
      progress.add(share / static_cast<double>(count));
    });
    for (const TubeSums& sum : batch) sums.add(sum);
  }
  return sums;
}

TubeSums trace_adaptive(const AdaptiveLook& look, Progress& progress, double share) {
  if (look.grid.cells() == 0)
    return sum_tiles(
        0, [](std::size_t) { return TubeSums{}; }, progress, share);
  const auto face_count = static_cast<std::uint32_t>(look.tree.faces().size());
  const std::size_t flat_tiles = (face_count + faces_per_tile - 1) / faces_per_tile;
  std::optional<CurvedLook> curved;
  std::optional<CurvedBounces> bounces;
  if (look.smooth) curved.emplace(look), bounces.emplace(look);
  const auto trace = [&](std::size_t i) {
    const auto begin = static_cast<std::uint32_t>(i) * faces_per_tile;
    if (i < flat_tiles) return trace_faces(look, begin, std::min(begin + faces_per_tile, face_count));
    return i < flat_tiles + CurvedLook::blocks ? curved->trace(i - flat_tiles) : bounces->trace(i - flat_tiles - CurvedLook::blocks);
  };
  return sum_tiles(flat_tiles + (curved ? CurvedLook::blocks + bounces->blocks() : 0), trace, progress, share);
}

}  // namespace

TubeSums sbr_scattering(const Tracer& tracer, const FaceTree& faces, const SmoothSurfaces* smooth, const Look& look,
                        std::span<const double> frequencies, const TubeOptions& options, Progress& progress, double share) {
  const SphericalBasis transmit = spherical_basis(look.transmit), receive = spherical_basis(look.receive);
  const double shortest = wavelength(*std::ranges::max_element(frequencies));
  const LaunchGrid grid = launch_grid(tracer.mesh(), look.transmit, shortest, options.per_wavelength, options.up);
  std::vector<double> wavenumbers(frequencies.size());
  std::ranges::transform(frequencies, wavenumbers.begin(), wavenumber);

  const AdaptiveLook adaptive{tracer,  faces,       grid,  transmit, receive, wavenumbers, options.max_bounces,
                              smooth, options.clip};
  if (options.mode == TubeMode::adaptive) return trace_adaptive(adaptive, progress, share);
  const Tiling tiles(grid);
  const auto trace = [&](std::size_t i) {
    return trace_tile(tracer, grid, tiles[i], transmit, receive, wavenumbers, options.max_bounces);
  };
  return sum_tiles(tiles.count, trace, progress, share);
}

}  // namespace raytube
