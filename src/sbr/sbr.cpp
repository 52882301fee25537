#include "sbr/sbr.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "sbr/beams/beam.h"
#include "sbr/beams/estimate.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/tolerances.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/launch/launch.h"
#include "sbr/launch/tile.h"
#include "sbr/look_parts.h"
#include "sbr/refinement.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

namespace {

// Powers of the cells' width with which errors fall: of tubes too narrow to be cut (theory/method.md), and of cells.
constexpr double order_of_polygons = 1.5, order_of_cells = 1.0;
// The cells per wavelength whose narrow tubes leave less than a decibel in the worst row of most looks at vehicles. Time grows
// with the square root of the density alone: a second grid costs more than a first one that is finer than it would have to be.
constexpr double density_for_a_decibel = 10.0;
// Where errors are permitted that are not known yet: on vehicles those of this density are a tenth of the model uncertainty in
// the median, and a quarter at worst in most looks.
constexpr double density_beside_a_model = 5.0;

// Of the densest grid that can be launched, the share that is not exceeded for the tolerance's sake.
constexpr double finest_grid = 0.9;

// Followed together: each beam between sheets keeps its fields at all of them.
constexpr std::size_t most_frequencies_with_sheets = 16;

// What of a part is traced on a grid of one density.
struct PartBlock {
  double per_wavelength;
  TubeSums sums{};
};

struct LookPart {
  PartKind kind;
  Division division{};
  std::vector<PartBlock> blocks{};
  TubeSums sums{};  // of all blocks

  // More cells make these sums better: there are some, or small polygons go on uncut.
  bool sampled(const TubeSums& of) const {
    return !of.coarse.empty() || ((kind == PartKind::flat || kind == PartKind::solid) && !of.pieces.empty());
  }

  // The blocks on grids of this density.
  std::vector<std::size_t> blocks_at(double per_wavelength) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < blocks.size(); ++i)
      if (blocks[i].per_wavelength == per_wavelength) found.push_back(i);
    return found;
  }
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
             const TubeWork& work)
      : scene_(scene),
        convexity_(options.skip ? scene.convexity : Convexity{}),
        look_(look),
        transmit_(spherical_basis(look.transmit)),
        receive_(spherical_basis(look.receive)),
        wavelength_(wavelength(std::ranges::max(frequencies))),
        tolerance_(relative_tolerance(options.tolerance_db)),
        options_(options),
        work_(work) {
    for (const double f : frequencies) wavenumbers_.push_back(wavenumber(f));
    if (!look.far()) antennas_.emplace(look, scene.radar, mesh().center);
    if (std::ranges::any_of(scene.materials, &Material::transmits))
      sheets_.emplace(mesh(), scene.materials, receive_, antennas_ ? &antennas_->receive : nullptr);
  }

  // What is traced by itself.
  std::vector<LookPart> parts() const {
    std::vector<LookPart> parts = outside_parts();
    if (any_solid(scene_.materials)) parts.push_back({PartKind::solid});
    return parts;
  }

  // All of a part, for the first time.
  void trace(LookPart& part, double share, CurrentMap* map) const {
    const LaunchGrid grid = grid_of_look(mesh(), look_, wavelength_, first_density(options_), options_.up);
    if (grid.cells() > 0)
      part.division = divide(part.kind, tube_look(grid, {scene_.materials, wavenumbers_, 0}, nullptr, nullptr));
    const double density = density_to_begin_with(part.division);
    part.blocks.assign(part.division.blocks, PartBlock{density});
    trace(part, part.blocks_at(density), density, share, map);
  }

  // The whole part once more, now with a map.
  void fill(CurrentMap& map, LookPart& part) const {
    std::set<double> densities;
    for (const PartBlock& block : part.blocks) densities.insert(block.per_wavelength);
    for (const double density : densities) trace(part, part.blocks_at(density), density, 0.0, &map);
  }

  // Fills the sums of these blocks.
  void trace(LookPart& part, const std::vector<std::size_t>& blocks, double density, double share, CurrentMap* map) const {
    const LaunchGrid grid = grid_of_look(mesh(), look_, wavelength_, density, options_.up);
    std::vector<TubeSums> traced = sums_of(part, blocks, grid, share, map);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      PartBlock& block = part.blocks[blocks[i]];
      traced[i].rays += block.sums.rays;
      block = {density, std::move(traced[i])};
      block.sums.error = numerical_error(block.sums, grid, wavenumbers_, mesh().radius);
    }
    add_up(part, grid);
  }

  // What errors of a look may be: more than the tolerance says only if that is exceeded.
  PermittedErrors permitted(const TubeSums& sums) const {
    PermittedErrors errors{tolerance_, {}};
    if (work_.permits && excess_of(sums, sums, errors) > 1.0) errors.in_any_case = work_.permits(sums);
    return errors;
  }

  // Traces those blocks again, more densely, whose share of the error is too large. False if the whole is not, or if none can be
  // made better.
  bool refine(std::vector<LookPart>& parts, const TubeSums& sums) const {
    const PermittedErrors errors_permitted = permitted(sums);
    if (!(excess_of(sums, sums, errors_permitted) > 1.0)) return false;
    bool any = false;
    const double most = densest();
    for (LookPart& part : parts) {
      const auto too_large = [&](const TubeSums& of) {
        return excess_of(of, sums, errors_permitted) * static_cast<double>(parts.size());
      };
      const double whole = too_large(part.sums);
      if (whole <= 1.0 || !part.sampled(part.sums)) continue;
      std::vector<BlockError> errors;
      for (const PartBlock& block : part.blocks)
        errors.push_back({part.sampled(block.sums) ? too_large(block.sums) : 0.0, block.per_wavelength < most});
      const auto [blocks, growth] = refinement(errors, whole, part.division.polygons ? order_of_polygons : order_of_cells);
      if (blocks.empty()) continue;
      double density = 0.0;
      for (const std::size_t i : blocks) density = std::max(density, part.blocks[i].per_wavelength);
      trace(part, blocks, std::min(growth * density, most), 0.0, nullptr);
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

  // Of waves that have never been inside of a solid.
  std::vector<LookPart> outside_parts() const {
    if (options_.mode == TubeMode::uniform) return {{PartKind::uniform}};
    std::vector<LookPart> parts{{PartKind::flat}};
    if (!options_.refines() || !scene_.smooth) return parts;
    parts.push_back({look_.far() ? PartKind::curved : PartKind::curved_near});
    if (!convexity_.no_reflection) parts.push_back({PartKind::curved_bounces});
    return parts;
  }

  // Of these blocks, some frequencies at a time where there are sheets.
  std::vector<TubeSums> sums_of(const LookPart& part, const std::vector<std::size_t>& blocks, const LaunchGrid& grid,
                                double share, CurrentMap* map) const {
    if (grid.cells() == 0) work_.progress.add(share);
    std::vector<TubeSums> all(blocks.size());
    const std::size_t count = grid.cells() > 0 ? wavenumbers_.size() : 0,
                      together = sheets_ && !map ? most_frequencies_with_sheets : wavenumbers_.size();
    for (std::size_t first = 0; first < count; first += together) {
      SpectralSurfaces surfaces{scene_.materials, wavenumbers_, first};
      surfaces.wavenumbers = surfaces.wavenumbers.subspan(first, std::min(together, count - first));
      std::optional<SphericalLook> spherical;
      if (antennas_) spherical.emplace(*antennas_, incident_beam(grid, transmit_, {}), surfaces, tolerance_);
      const double part_of_share = share * static_cast<double>(surfaces.wavenumbers.size()) / static_cast<double>(count);
      const TubeLook look = tube_look(grid, surfaces, spherical ? &*spherical : nullptr, map);
      std::vector<TubeSums> some = trace_blocks(part.kind, part.division, look, blocks, work_.progress, part_of_share);
      for (std::size_t i = 0; i < blocks.size(); ++i)
        if (first == 0)
          all[i] = std::move(some[i]);
        else
          all[i].append(std::move(some[i]));
    }
    return all;
  }

  // How many times the errors of a part of all sums are what those may have.
  double excess_of(const TubeSums& part, const TubeSums& all, const PermittedErrors& errors) const {
    return excess(all, part.error, errors, look_.transmit == look_.receive);
  }

  // Of cells the usual one; the few narrow tubes among polygons cost little, so they begin where they may do.
  double density_to_begin_with(const Division& division) const {
    const bool fixed = options_.per_wavelength >= options_.max_per_wavelength;
    if (!options_.refines() || !division.polygons || fixed) return first_density(options_);
    const double for_tolerance = density_for_a_decibel * std::pow(options_.tolerance_db, -1.0 / order_of_polygons);
    return std::min({for_tolerance, work_.permits ? density_beside_a_model : for_tolerance, densest()});
  }

  double densest() const {
    return std::min(options_.max_per_wavelength, finest_grid * densest_grid(mesh(), look_, wavelength_, options_.up));
  }

  void add_up(LookPart& part, const LaunchGrid& grid) const {
    part.sums = {};
    for (const PartBlock& block : part.blocks) part.sums.add(block.sums);
    part.sums.error = numerical_error(part.sums, grid, wavenumbers_, mesh().radius);
  }

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
            .tolerance = tolerance_,
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
  const TubeWork& work_;
  std::vector<double> wavenumbers_;
  std::optional<AntennaPair> antennas_;
  std::optional<LineOfSightSheets> sheets_;
};

}  // namespace

TubeSums sbr_scattering(const TubeScene& scene, const Look& look, std::span<const double> frequencies, const TubeOptions& options,
                        const TubeWork& work) {
  const LookTracer tracer(scene, look, frequencies, options, work);
  std::vector<LookPart> parts = tracer.parts();
  CurrentMap* const first_map = options.refines() ? nullptr : work.map;
  for (LookPart& part : parts) tracer.trace(part, work.share / static_cast<double>(parts.size()), first_map);
  if (!options.refines()) return tracer.with_truncated_tubes(parts.size() == 1 ? std::move(parts.front().sums) : total(parts));
  // Each part is sampled more finely until the whole is as good as it has to be.
  TubeSums sums = total(parts);
  while (tracer.refine(parts, sums)) sums = total(parts);
  if (work.map)
    for (LookPart& part : parts) tracer.fill(*work.map, part);
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

// Of those that are refined both the old ones and the new.
double block_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies) {
  return 2.0 * std::min(static_cast<double>(tiles) * tile_sum_bytes(bounces, frequencies), bytes_of_blocks);
}

// Beams of two bounces: most_tubes before a meeting, and after it twice as many, or more where facets divide them.
double tubes_between_sheets_bytes(std::size_t frequencies) {
  constexpr double beams = 4.0 * most_tubes;
  return beams *
         static_cast<double>(2 * sizeof(Footprint) + std::min(frequencies, most_frequencies_with_sheets) * sizeof(SpectralWave));
}

std::size_t tiles_of_look(const Tracer& tracer, const FaceTree& faces, const Look& look, std::span<const double> frequencies,
                          const TubeOptions& options, bool sheets) {
  const std::size_t together = sheets ? faces_per_tile_with_sheets : faces_per_tile;
  if (options.mode == TubeMode::adaptive) return (faces.faces().size() + together - 1) / together;
  const double shortest = wavelength(std::ranges::max(frequencies));
  return Tiling(grid_of_look(tracer.mesh(), look, shortest, options.per_wavelength, options.up)).count();
}

}  // namespace raytube
