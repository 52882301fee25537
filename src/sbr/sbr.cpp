#include "sbr/sbr.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "sbr/adaptive.h"
#include "sbr/curved_cells.h"
#include "sbr/curved_tubes.h"
#include "sbr/estimate.h"
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

TubeSums trace_uniform(const AdaptiveLook& look, Progress& progress, double share) {
  const Tiling tiles(look.grid);
  const NotTraced not_traced{look.skip ? &look.tree : nullptr, look.known.no_reflection};
  tbb::enumerable_thread_specific<TileTracer> tile_tracers([&] {
    return TileTracer(look.tracer, look.grid, look.transmit, look.receive, look.wavenumbers, look.max_bounces, look.smooth,
                      not_traced);
  });
  const auto trace = [&](std::size_t i) { return tile_tracers.local().trace(tiles[i]); };
  return sum_tiles(tiles.count, trace, progress, share);
}

TubeSums trace_flat(const AdaptiveLook& look, Progress& progress, double share) {
  const auto face_count = static_cast<std::uint32_t>(look.tree.faces().size());
  const auto trace = [&](std::size_t i) {
    const auto begin = static_cast<std::uint32_t>(i) * faces_per_tile;
    return trace_faces(look, begin, std::min(begin + faces_per_tile, face_count));
  };
  return sum_tiles((face_count + faces_per_tile - 1) / faces_per_tile, trace, progress, share);
}

TubeSums trace_curved(const AdaptiveLook& look, Progress& progress, double share) {
  const CurvedLook first(look);
  const CurvedBounces later(look);
  const auto trace = [&](std::size_t i) { return i < CurvedLook::blocks ? first.trace(i) : later.trace(i - CurvedLook::blocks); };
  return sum_tiles(CurvedLook::blocks + (look.known.no_reflection ? 0 : later.blocks()), trace, progress, share);
}

// Times the work of a cell that of a flat face is.
constexpr double cells_per_face = 40.0;

// Half the faces of a body look at the radar. Where a face is dearer than the cells it covers, single rays are the cheaper
// sample.
bool cells_are_cheaper(const AdaptiveLook& look) {
  const auto is_flat = [&](const Face& face) { return !look.smooth || look.smooth->region(face.triangle) == no_index; };
  const auto flat = std::ranges::count_if(look.tree.faces(), is_flat);
  const double per_face = look.clip ? cells_per_face : 1.0;
  return flat > faces_per_tile && 0.5 * per_face * static_cast<double>(flat) > static_cast<double>(look.grid.cells());
}

TubeSums trace_adaptive(const AdaptiveLook& look, Progress& progress, double share) {
  if (look.grid.cells() == 0) {
    progress.add(share);
    return {};
  }
  const double part = look.smooth ? 0.5 * share : share;
  TubeSums sums = cells_are_cheaper(look) ? trace_uniform(look, progress, part) : trace_flat(look, progress, part);
  if (look.smooth) sums.add(trace_curved(look, progress, part));
  return sums;
}

// Cells per wavelength to begin with, and the least and the most by which they grow.
constexpr double first_per_wavelength = 10.0, least_growth = 1.5, most_growth = 3.0;

}  // namespace

TubeSums sbr_scattering(const Tracer& tracer, const FaceTree& faces, const SmoothSurfaces* smooth, const Convexity& convexity,
                        const Look& look, std::span<const double> frequencies, const TubeOptions& options, Progress& progress,
                        double share) {
  const SphericalBasis transmit = spherical_basis(look.transmit), receive = spherical_basis(look.receive);
  std::vector<double> wavenumbers(frequencies.size());
  std::ranges::transform(frequencies, wavenumbers.begin(), wavenumber);
  const double shortest = wavelength(*std::ranges::max_element(frequencies)), tolerance = relative_error(options.tolerance_db);
  const bool adaptive = options.mode == TubeMode::adaptive, refined = adaptive && options.clip;
  double per_wavelength = refined ? std::min(first_per_wavelength, options.per_wavelength) : options.per_wavelength;
  const Convexity known = options.skip ? convexity : Convexity{};
  std::uint64_t rays = 0;
  while (true) {
    const LaunchGrid grid = launch_grid(tracer.mesh(), look.transmit, shortest, per_wavelength, options.up);
    const AdaptiveLook view{tracer,       faces,     grid,   transmit,     receive,
                            wavenumbers,  tolerance, smooth, options.clip, options.max_bounces,
                            options.skip, known};
    TubeSums sums = adaptive ? trace_adaptive(view, progress, share) : trace_uniform(view, progress, share);
    sums.error = numerical_error(sums, grid, wavenumbers, tracer.mesh().radius);
    sums.rays += rays;
    const double too_large = excess(sums, sums.error, tolerance);
    if (!refined || sums.coarse.empty() || too_large <= 1.0 || per_wavelength >= options.per_wavelength) return sums;
    per_wavelength = std::min(per_wavelength * std::clamp(too_large, least_growth, most_growth), options.per_wavelength);
    rays = sums.rays;
    share = 0.0;
  }
}

}  // namespace raytube
