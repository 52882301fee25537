#include "sbr/sbr.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/threads.h"
#include "sbr/beams/estimate.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/curved/curved_cells.h"
#include "sbr/curved/curved_tubes.h"
#include "sbr/flat/adaptive.h"
#include "sbr/flat/tile.h"
#include "sbr/launch/launch.h"

namespace raytube {

namespace {

// Tiles whose sums are held at a time: bounds memory however large the grid is. Fewer where these are large, with many
// frequencies, but enough for a few threads.
constexpr std::size_t tiles_per_batch = 128, least_tiles_per_batch = 8;
constexpr double bytes_per_batch = 64e6;

double tile_bytes(int bounces, std::size_t frequencies) {
  return static_cast<double>(frequencies) *
         (static_cast<double>(bounces) * sizeof(ScatteringMatrix) + coarse_grids * sizeof(ErrorSum));
}

std::size_t batch_of(int bounces, std::size_t frequencies) {
  const double most = bytes_per_batch / tile_bytes(bounces, frequencies);
  return most > tiles_per_batch ? tiles_per_batch : std::max(least_tiles_per_batch, static_cast<std::size_t>(most));
}

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

// Faces whose tubes are followed together. Between sheets tubes double at every meeting, so that those of few faces are many.
constexpr std::uint32_t faces_per_tile = 256, faces_per_tile_with_sheets = 8;
// Followed together: each beam between sheets keeps its fields at all of them.
constexpr std::size_t most_frequencies_with_sheets = 16;

// Adds up tile(0) ... tile(count - 1) in this order, whoever computes them; what is told to a map, one thread does.
template <class Function>
TubeSums sum_tiles(const AdaptiveLook& look, std::size_t count, Function tile, Progress& progress, double share) {
  if (count == 0) progress.add(share);
  TubeSums sums;
  const std::size_t most = batch_of(look.known.no_reflection ? 1 : look.max_bounces, look.wavenumbers.size());
  for (std::size_t first = 0; first < count; first += most) {
    std::vector<TubeSums> batch(std::min(most, count - first));
    const auto trace = [&](std::size_t i) {
      batch[i] = tile(first + i);
      progress.add(share / static_cast<double>(count));
    };
    if (look.map)
      for (std::size_t i = 0; i < batch.size(); ++i) trace(i);
    else
      tbb::parallel_for(std::size_t{0}, batch.size(), trace);
    stop_if_cancelled();
    for (const TubeSums& sum : batch) sums.add(sum);
  }
  return sums;
}

TubeSums trace_uniform(const AdaptiveLook& look, Progress& progress, double share) {
  const Tiling tiles(look.grid);
  const NotTraced not_traced{look.skip ? &look.tree : nullptr, look.known.no_reflection};
  tbb::enumerable_thread_specific<TileTracer> tile_tracers([&] {
    return TileTracer(look.tracer, look.surfaces, look.grid, look.transmit, look.receive, look.spherical, look.max_bounces,
                      look.smooth, not_traced, look.sheets, look.map);
  });
  const auto trace = [&](std::size_t i) { return tile_tracers.local().trace(tiles[i]); };
  return sum_tiles(look, tiles.count, trace, progress, share);
}

TubeSums trace_flat(const AdaptiveLook& look, Progress& progress, double share) {
  const auto face_count = static_cast<std::uint32_t>(look.tree.faces().size());
  const std::uint32_t together = look.sheets ? faces_per_tile_with_sheets : faces_per_tile;
  const auto trace = [&](std::size_t i) {
    const auto begin = static_cast<std::uint32_t>(i) * together;
    return trace_faces(look, begin, std::min(begin + together, face_count));
  };
  return sum_tiles(look, (face_count + together - 1) / together, trace, progress, share);
}

// So many cells a flat face is worth: it takes longer than they do, but less long than those that come as close.
constexpr double cells_per_face = 5.0;

// Half the faces of a body look at the radar. Where a face is dearer than the cells it covers, single rays are the cheaper
// sample.
bool cells_are_cheaper(const AdaptiveLook& look) {
  const auto is_flat = [&](const Face& face) { return !look.smooth || look.smooth->region(face.triangle) == no_index; };
  const auto flat = std::ranges::count_if(look.tree.faces(), is_flat);
  const double per_face = look.clip ? cells_per_face : 1.0;
  return flat > faces_per_tile && 0.5 * per_face * static_cast<double>(flat) > static_cast<double>(look.grid.cells());
}

TubeSums light_curved_facets(const AdaptiveLook& look, std::uint32_t begin, std::uint32_t end) {
  TubeSums sums;
  sums.at(0, look.wavenumbers.size());
  for (std::uint32_t t = begin; t < end; ++t) {
    if (look.smooth->region(t) == no_index) continue;
    if (look.spherical->add(sums, look.smooth->facet(t))) ++sums.hits[0];
  }
  sums.tubes = sums.hits[0];
  return sums;
}

TubeSums trace_faces_or_cells(const AdaptiveLook& look, Progress& progress, double share) {
  return cells_are_cheaper(look) ? trace_uniform(look, progress, share) : trace_flat(look, progress, share);
}

TubeSums trace_curved(const AdaptiveLook& look, Progress& progress, double share) {
  const CurvedLook curved(look);
  return sum_tiles(
      look, CurvedLook::blocks, [&](std::size_t i) { return curved.trace(i); }, progress, share);
}

// Curved surfaces of a convex body as antennas at a finite distance see them: no tube, facet by facet.
TubeSums trace_curved_near(const AdaptiveLook& look, Progress& progress, double share) {
  const auto count = static_cast<std::uint32_t>(look.tracer.mesh().triangles.size());
  const auto trace = [&](std::size_t i) {
    const auto begin = static_cast<std::uint32_t>(i) * faces_per_tile;
    return light_curved_facets(look, begin, std::min(begin + faces_per_tile, count));
  };
  return sum_tiles(look, (count + faces_per_tile - 1) / faces_per_tile, trace, progress, share);
}

TubeSums trace_curved_bounces(const AdaptiveLook& look, Progress& progress, double share) {
  const CurvedBounces bounces(look);
  return sum_tiles(
      look, bounces.blocks(), [&](std::size_t i) { return bounces.trace(i); }, progress, share);
}

// The least and the most by which cells per wavelength grow.
constexpr double least_growth = 1.5, most_growth = 4.0;

// Of the densest grid that can be launched, the share that is not exceeded for the tolerance's sake.
constexpr double finest_grid = 0.9;

// A part of a look, on a grid of its own density.
struct Part {
  TubeSums (*trace)(const AdaptiveLook&, Progress&, double share);
  double per_wavelength;
  TubeSums sums{};

  // More cells make it better: there are some, or small polygons became some.
  bool sampled() const { return !sums.coarse.empty() || (trace == trace_faces_or_cells && !sums.pieces.empty()); }
};

TubeSums total(const std::vector<Part>& parts) {
  TubeSums sums;
  for (const Part& part : parts) {
    sums.add(part.sums);
    sums.error.resize(part.sums.error.size());
    for (std::size_t f = 0; f < sums.error.size(); ++f)
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) sums.error[f][p][q] += part.sums.error[f][p][q];
  }
  return sums;
}

// One look with these options, at any density.
class LookTracer {
 public:
  LookTracer(const Tracer& tracer, const FaceTree& faces, const SmoothSurfaces* smooth, const Convexity& convexity,
             const Look& look, const Radar& radar, std::span<const double> frequencies, std::span<const Material> materials,
             const TubeOptions& options, Progress& progress)
      : tracer_(tracer),
        faces_(faces),
        smooth_(smooth),
        known_(options.skip ? convexity : Convexity{}),
        look_(look),
        transmit_(spherical_basis(look.transmit)),
        receive_(spherical_basis(look.receive)),
        wavelength_(wavelength(std::ranges::max(frequencies))),
        tolerance_(relative_error(options.tolerance_db)),
        options_(options),
        progress_(progress),
        materials_(materials) {
    for (const double f : frequencies) wavenumbers_.push_back(wavenumber(f));
    if (!look.far()) antennas_.emplace(look, radar, tracer.mesh().center);
    if (std::ranges::any_of(materials, &Material::transmits)) sheets_.emplace(tracer.mesh(), materials, receive_);
  }

  TubeSums once(double share, CurrentMap* map) const {
    Part part{options_.mode == TubeMode::adaptive ? trace_faces_or_cells : trace_uniform, first_density(options_)};
    retrace(part, share, map);
    return with_truncated_tubes(std::move(part.sums));
  }

  /// Each part is sampled more finely until the whole is within the tolerance.
  TubeSums refined(double share, CurrentMap* map) const {
    const double density = first_density(options_);
    std::vector<Part> parts{{trace_faces_or_cells, density}};
    if (smooth_) parts.push_back({look_.far() ? trace_curved : trace_curved_near, density});
    if (smooth_ && !known_.no_reflection) parts.push_back({trace_curved_bounces, density});
    for (Part& part : parts) retrace(part, share / static_cast<double>(parts.size()));
    TubeSums sums = total(parts);
    while (excess(sums, sums.error, tolerance_) > 1.0 && refine(parts, sums)) sums = total(parts);
    if (map)
      for (Part& part : parts) retrace(part, 0.0, map);
    return with_truncated_tubes(std::move(sums));
  }

 private:
  // Of conductors alone the number of bounces belongs to the model.
  TubeSums with_truncated_tubes(TubeSums sums) const {
    if (!materials_.empty()) add_truncated_tubes(sums);
    return sums;
  }

  // False if no part can be made better.
  bool refine(std::vector<Part>& parts, const TubeSums& sums) const {
    bool any = false;
    const double most =
        std::min(options_.max_per_wavelength, finest_grid * densest_grid(tracer_.mesh(), look_, wavelength_, options_.up));
    for (Part& part : parts) {
      const double too_large = excess(sums, part.sums.error, tolerance_) * static_cast<double>(parts.size());
      if (too_large <= 1.0 || !part.sampled() || part.per_wavelength >= most) continue;
      part.per_wavelength = std::min(part.per_wavelength * std::clamp(too_large, least_growth, most_growth), most);
      retrace(part, 0.0);
      any = true;
    }
    return any;
  }

  void retrace(Part& part, double share, CurrentMap* map = nullptr) const {
    const LaunchGrid grid = grid_of_look(tracer_.mesh(), look_, wavelength_, part.per_wavelength, options_.up);
    const std::uint64_t rays_before = part.sums.rays;
    part.sums = {};
    if (grid.cells() == 0) progress_.add(share);
    const std::size_t count = grid.cells() > 0 ? wavenumbers_.size() : 0,
                      together = sheets_ && !map ? most_frequencies_with_sheets : wavenumbers_.size();
    for (std::size_t first = 0; first < count; first += together) {
      SpectralSurfaces surfaces{materials_, wavenumbers_, first};
      surfaces.wavenumbers = surfaces.wavenumbers.subspan(first, std::min(together, count - first));
      const double part_of_share = share * static_cast<double>(surfaces.wavenumbers.size()) / static_cast<double>(count);
      TubeSums sums = trace(part, grid, surfaces, part_of_share, map);
      if (first == 0)
        part.sums = std::move(sums);
      else
        part.sums.append(std::move(sums));
    }
    part.sums.rays += rays_before;
    part.sums.error = numerical_error(part.sums, grid, wavenumbers_, tracer_.mesh().radius);
  }

  TubeSums trace(const Part& part, const LaunchGrid& grid, const SpectralSurfaces& surfaces, double share,
                 CurrentMap* map) const {
    std::optional<SphericalLook> spherical;
    if (antennas_) spherical.emplace(*antennas_, incident_beam(grid, transmit_, {}), wavenumbers_, tolerance_);
    const AdaptiveLook view{tracer_,
                            faces_,
                            grid,
                            transmit_,
                            receive_,
                            spherical ? &*spherical : nullptr,
                            surfaces.wavenumbers,
                            surfaces,
                            tolerance_,
                            smooth_,
                            options_.clip,
                            options_.max_bounces,
                            options_.skip,
                            known_,
                            sheets_ ? &*sheets_ : nullptr,
                            map};
    return part.trace(view, progress_, share);
  }

  const Tracer& tracer_;
  const FaceTree& faces_;
  const SmoothSurfaces* smooth_;
  Convexity known_;
  const Look& look_;
  SphericalBasis transmit_, receive_;
  double wavelength_, tolerance_;
  const TubeOptions& options_;
  Progress& progress_;
  std::vector<double> wavenumbers_;
  std::span<const Material> materials_;
  std::optional<AntennaPair> antennas_;
  std::optional<LineOfSightSheets> sheets_;
};

}  // namespace

double first_density(const TubeOptions& options) {
  return options.refines() ? std::min(options.per_wavelength, options.max_per_wavelength) : options.per_wavelength;
}

double look_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies) {
  // The batch, the sum of all batches, and the look's own result.
  const std::size_t held = std::min(tiles, batch_of(bounces, frequencies)) + 2;
  return static_cast<double>(held) * tile_bytes(bounces, frequencies);
}

// Beams of two bounces: most_tubes before a meeting, and after it twice as many, or more where facets divide them.
double tubes_between_sheets_bytes(std::size_t frequencies) {
  constexpr double beams = 4.0 * most_tubes;
  return beams *
         static_cast<double>(2 * sizeof(Footprint) + std::min(frequencies, most_frequencies_with_sheets) * sizeof(SpectralWave));
}

std::size_t tiles_of_look(const Tracer& tracer, const FaceTree& faces, const Look& look, std::span<const double> frequencies,
                          const TubeOptions& options) {
  if (options.mode == TubeMode::adaptive) return (faces.faces().size() + faces_per_tile - 1) / faces_per_tile;
  const double shortest = wavelength(std::ranges::max(frequencies));
  return Tiling(grid_of_look(tracer.mesh(), look, shortest, options.per_wavelength, options.up)).count;
}

TubeSums sbr_scattering(const Tracer& tracer, const FaceTree& faces, const SmoothSurfaces* smooth, const Convexity& convexity,
                        const Look& look, std::span<const double> frequencies, const TubeOptions& options, Progress& progress,
                        double share, const Radar& radar, std::span<const Material> materials, CurrentMap* map) {
  const LookTracer tubes(tracer, faces, smooth, convexity, look, radar, frequencies, materials, options, progress);
  return options.mode == TubeMode::adaptive && options.clip ? tubes.refined(share, map) : tubes.once(share, map);
}

}  // namespace raytube
