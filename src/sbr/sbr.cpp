#include "sbr/sbr.h"

#include <algorithm>
#include <optional>

#include "sbr/beams/beam.h"
#include "sbr/beams/estimate.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/tolerances.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/launch/launch.h"
#include "sbr/launch/tile.h"
#include "sbr/look_parts.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

namespace {

// The least and the most by which cells per wavelength grow.
constexpr double least_growth = 1.5, most_growth = 4.0;

// Of the densest grid that can be launched, the share that is not exceeded for the tolerance's sake.
constexpr double finest_grid = 0.9;

// Followed together: each beam between sheets keeps its fields at all of them.
constexpr std::size_t most_frequencies_with_sheets = 16;

// A part of a look, on a grid of its own density.
struct LookPart {
  PartKind kind;
  double per_wavelength;
  TubeSums sums{};

  // More cells make it better: there are some, or small polygons became some.
  bool sampled() const { return !sums.coarse.empty() || (kind == PartKind::flat && !sums.pieces.empty()); }
};

TubeSums total(const std::vector<LookPart>& parts) {
  TubeSums sums;
  for (const LookPart& part : parts) {
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
  LookTracer(const TubeScene& scene, const Look& look, std::span<const double> frequencies, const TubeOptions& options,
             Progress& progress)
      : scene_(scene),
        convexity_(options.skip ? scene.convexity : Convexity{}),
        look_(look),
        transmit_(spherical_basis(look.transmit)),
        receive_(spherical_basis(look.receive)),
        wavelength_(wavelength(std::ranges::max(frequencies))),
        tolerance_(relative_tolerance(options.tolerance_db)),
        options_(options),
        progress_(progress) {
    for (const double f : frequencies) wavenumbers_.push_back(wavenumber(f));
    if (!look.far()) antennas_.emplace(look, scene.radar, mesh().center);
    if (std::ranges::any_of(scene.materials, &Material::transmits)) sheets_.emplace(mesh(), scene.materials, receive_);
  }

  // What is traced by itself, at first all at the same density.
  std::vector<LookPart> parts() const {
    const double density = first_density(options_);
    if (options_.mode == TubeMode::uniform) return {{PartKind::uniform, density}};
    std::vector<LookPart> parts{{PartKind::flat, density}};
    if (!options_.refines() || !scene_.smooth) return parts;
    parts.push_back({look_.far() ? PartKind::curved : PartKind::curved_near, density});
    if (!convexity_.no_reflection) parts.push_back({PartKind::curved_bounces, density});
    return parts;
  }

  // Fills part.sums, some frequencies at a time where there are sheets.
  void trace(LookPart& part, double share, CurrentMap* map) const {
    const LaunchGrid grid = grid_of_look(mesh(), look_, wavelength_, part.per_wavelength, options_.up);
    const std::uint64_t rays_before = part.sums.rays;
    part.sums = {};
    if (grid.cells() == 0) progress_.add(share);
    std::optional<SphericalLook> spherical;
    if (antennas_) spherical.emplace(*antennas_, incident_beam(grid, transmit_, {}), wavenumbers_, tolerance_);
    const std::size_t count = grid.cells() > 0 ? wavenumbers_.size() : 0,
                      together = sheets_ && !map ? most_frequencies_with_sheets : wavenumbers_.size();
    for (std::size_t first = 0; first < count; first += together) {
      SpectralSurfaces surfaces{scene_.materials, wavenumbers_, first};
      surfaces.wavenumbers = surfaces.wavenumbers.subspan(first, std::min(together, count - first));
      const double part_of_share = share * static_cast<double>(surfaces.wavenumbers.size()) / static_cast<double>(count);
      TubeSums sums =
          trace_part(part.kind, tube_look(grid, surfaces, spherical ? &*spherical : nullptr, map), progress_, part_of_share);
      if (first == 0)
        part.sums = std::move(sums);
      else
        part.sums.append(std::move(sums));
    }
    part.sums.rays += rays_before;
    part.sums.error = numerical_error(part.sums, grid, wavenumbers_, mesh().radius);
  }

  bool within_tolerance(const TubeSums& sums) const { return !(excess(sums, sums.error, tolerance_) > 1.0); }

  // Traces those parts again, more densely, whose share of the error is too large. False if no part can be made better.
  bool refine(std::vector<LookPart>& parts, const TubeSums& sums) const {
    bool any = false;
    const double most =
        std::min(options_.max_per_wavelength, finest_grid * densest_grid(mesh(), look_, wavelength_, options_.up));
    for (LookPart& part : parts) {
      const double too_large = excess(sums, part.sums.error, tolerance_) * static_cast<double>(parts.size());
      if (too_large <= 1.0 || !part.sampled() || part.per_wavelength >= most) continue;
      part.per_wavelength = std::min(part.per_wavelength * std::clamp(too_large, least_growth, most_growth), most);
      trace(part, 0.0, nullptr);
      any = true;
    }
    return any;
  }

  // Of conductors alone the number of bounces belongs to the model.
  TubeSums with_truncated_tubes(TubeSums sums) const {
    if (!scene_.materials.empty()) add_truncated_tubes(sums);
    return sums;
  }

 private:
  const TriangleMesh& mesh() const { return scene_.tracer.mesh(); }

  TubeLook tube_look(const LaunchGrid& grid, const SpectralSurfaces& surfaces, const SphericalLook* spherical,
                     CurrentMap* map) const {
    return {.tracer = scene_.tracer,
            .faces = scene_.faces,
            .grid = grid,
            .transmit = transmit_,
            .receive = receive_,
            .surfaces = surfaces,
            .spherical = spherical,
            .smooth = scene_.smooth,
            .sheets = sheets_ ? &*sheets_ : nullptr,
            .map = map,
            .convexity = convexity_,
            .phase_tolerance = phase_tolerance(tolerance_),
            .max_bounces = options_.max_bounces,
            .clip = options_.clip,
            .skip = options_.skip};
  }

  const TubeScene& scene_;
  Convexity convexity_;
  const Look& look_;
  SphericalBasis transmit_, receive_;
  double wavelength_, tolerance_;
  const TubeOptions& options_;
  Progress& progress_;
  std::vector<double> wavenumbers_;
  std::optional<AntennaPair> antennas_;
  std::optional<LineOfSightSheets> sheets_;
};

}  // namespace

TubeSums sbr_scattering(const TubeScene& scene, const Look& look, std::span<const double> frequencies, const TubeOptions& options,
                        const TubeWork& work) {
  const LookTracer tracer(scene, look, frequencies, options, work.progress);
  std::vector<LookPart> parts = tracer.parts();
  CurrentMap* const first_map = options.refines() ? nullptr : work.map;
  for (LookPart& part : parts) tracer.trace(part, work.share / static_cast<double>(parts.size()), first_map);
  if (!options.refines()) return tracer.with_truncated_tubes(std::move(parts.front().sums));
  // Each part is sampled more finely until the whole is within the tolerance.
  TubeSums sums = total(parts);
  while (!tracer.within_tolerance(sums) && tracer.refine(parts, sums)) sums = total(parts);
  if (work.map)
    for (LookPart& part : parts) tracer.trace(part, 0.0, work.map);
  return tracer.with_truncated_tubes(std::move(sums));
}

double first_density(const TubeOptions& options) {
  return options.refines() ? std::min(options.per_wavelength, options.max_per_wavelength) : options.per_wavelength;
}

double look_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies) {
  // The batch, the sum of all batches, and the look's own result.
  const std::size_t held = std::min(tiles, tiles_per_batch(bounces, frequencies)) + 2;
  return static_cast<double>(held) * tile_sum_bytes(bounces, frequencies);
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
  return Tiling(grid_of_look(tracer.mesh(), look, shortest, options.per_wavelength, options.up)).count();
}

}  // namespace raytube
