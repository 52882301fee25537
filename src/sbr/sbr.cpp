#include "sbr/sbr.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <ranges>

#include "sbr/beams/beam.h"
#include "sbr/beams/current_map.h"
#include "sbr/beams/estimate.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/tolerances.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/launch/launch.h"
#include "sbr/launch/tile.h"
#include "sbr/look_parts.h"
#include "sbr/refinement.h"
#include "sbr/visible/line_of_sight.h"
#include "scene/frequency_bands.h"

namespace raytube {

namespace {

// Powers of the cells' width with which errors fall: of tubes too narrow to be cut (theory/method.md), and of cells.
constexpr double order_of_polygons = 1.5, order_of_cells = 1.0;
// The cells per wavelength whose narrow tubes leave, at vehicles, less than a tenth of a decibel in most rows and less than one in
// nearly all. Time grows with the square root of the density alone: a second grid costs more than a first one that is finer than
// it would have to be.
constexpr double density_for_a_decibel = 5.0;
// What a row is taken to be permitted, in decibels, before its model uncertainty is known: that of vehicles permits more.
constexpr double permitted_at_first = 1.0;

// Share of the densest grid that can be launched which the tolerance alone does not exceed.
constexpr double finest_grid = 0.9;

// Followed together: each beam between sheets keeps its fields at all of them.
constexpr std::size_t most_frequencies_with_sheets = 16;

// Grids of a part are denser by the root of two from rung to rung of a ladder, so that rows which ask for almost the same ask for
// the same.
double density_on(int rung, double first) { return std::ldexp(rung % 2 == 0 ? first : first * std::numbers::sqrt2, rung / 2); }

// What of a look is traced by itself, in blocks: what is known of each, by rung.
struct LookPart {
  PartKind kind;
  Division division{};
  double first_density = 0.0;  // cells per wavelength, of rung 0
  std::vector<std::map<int, TubeSums>> blocks{};
  std::uint64_t rays = 0;  // traced so far

  // More cells make these sums better: there are some, or small polygons go on uncut.
  bool sampled(const TubeSums& of) const {
    return !of.coarse.empty() || ((kind == PartKind::flat || kind == PartKind::solid) && !of.pieces.empty());
  }
};

using Rungs = std::vector<int>;  // [block]

// Rows that ask for the same grids. Each asks by itself, so that none depends on which others are computed.
struct RowGroup {
  std::vector<Rungs> rungs;  // [part]
  std::vector<std::size_t> rows;
};

// A total's errors are those of its parts added up.
TubeSums total(const std::vector<TubeSums>& parts) {
  TubeSums sums;
  for (const TubeSums& part : parts) {
    sums.add(part);
    sums.error.resize(part.error.size());
    for (std::size_t f = 0; f < sums.error.size(); ++f) add(part.error[f], sums.error[f]);
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
        wavelength_(wavelength(options.refines() ? sampling_frequency(frequencies) : std::ranges::max(frequencies))),
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
    std::vector<LookPart> parts{{options_.mode == TubeMode::uniform ? PartKind::uniform : PartKind::flat}};
    if (options_.refines() && scene_.smooth) {
      parts.push_back({look_.far() ? PartKind::curved : PartKind::curved_near});
      if (!convexity_.no_reflection) parts.push_back({PartKind::curved_bounces});
    }
    if (any_solid(scene_.materials)) parts.push_back({PartKind::solid});
    return parts;
  }

  // Divides a part, and traces all of it for the first time.
  void begin(LookPart& part, double share, CurrentMap* map) const {
    const LaunchGrid grid = grid_of_look(mesh(), look_, wavelength_, first_density(options_), options_.up);
    if (grid.cells() > 0)
      part.division = divide(part.kind, tube_look(grid, {scene_.materials, wavenumbers_, 0}, nullptr, nullptr));
    part.first_density = density_to_begin_with(part.division);
    part.blocks.resize(part.division.blocks);
    trace(part, Rungs(part.division.blocks), share, map);
  }

  // Every block on its rung, unless it is known there. Some frequencies at a time where there are sheets.
  void trace(LookPart& part, const Rungs& rungs, double share, CurrentMap* map) const {
    const std::size_t count = wavenumbers_.size(), together = sheets_ && !map ? most_frequencies_with_sheets : count;
    for (const auto& [rung, blocks] : by_rung(part, rungs, map != nullptr)) {
      const LaunchGrid grid = grid_of(part, rung);
      std::vector<TubeSums> sums(blocks.size());
      if (grid.cells() == 0) work_.progress.add(share);
      for (std::size_t first = 0; first < count && grid.cells() > 0; first += together) {
        SpectralSurfaces surfaces{scene_.materials, wavenumbers_, first};
        surfaces.wavenumbers = surfaces.wavenumbers.subspan(first, std::min(together, count - first));
        std::optional<SphericalLook> spherical;
        if (antennas_) spherical.emplace(*antennas_, incident_beam(grid, transmit_, {}), surfaces, tolerance_);
        const double part_of_share = share * static_cast<double>(surfaces.wavenumbers.size()) / static_cast<double>(count);
        const TubeLook look = tube_look(grid, surfaces, spherical ? &*spherical : nullptr, map);
        std::vector<TubeSums> some = trace_blocks(part.kind, part.division, look, blocks, work_.progress, part_of_share);
        if (first == 0)
          sums = std::move(some);
        else
          for (std::size_t i = 0; i < blocks.size(); ++i) sums[i].append(std::move(some[i]));
      }
      for (std::size_t i = 0; i < blocks.size(); ++i) {
        sums[i].error = numerical_error(sums[i], grid, wavenumbers_, mesh().radius);
        if (!part.blocks[blocks[i]].contains(rung)) part.rays += sums[i].rays;
        part.blocks[blocks[i]].insert_or_assign(rung, std::move(sums[i]));
      }
    }
  }

  RowGroup all_rows(std::span<const LookPart> parts) const {
    RowGroup group;
    for (const LookPart& part : parts) group.rungs.emplace_back(part.division.blocks);
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) group.rows.push_back(f);
    return group;
  }

  // What all blocks of a part add up to on these grids.
  TubeSums sums_at(const LookPart& part, const Rungs& rungs) const {
    TubeSums sums;
    for (std::size_t i = 0; i < rungs.size(); ++i) sums.add(part.blocks[i].at(rungs[i]));
    sums.error = numerical_error(sums, grid_of(part, 0), wavenumbers_, mesh().radius);
    return sums;
  }

  // Takes to `result` the rows of a group that are as good as they have to be, or as good as they can be made. Returns the others
  // by what they ask for now: denser grids where a block's share of the error is too large.
  std::vector<RowGroup> settle(const RowGroup& group, std::vector<LookPart>& parts, TubeSums& result) const {
    std::vector<TubeSums> sums;
    for (std::size_t i = 0; i < parts.size(); ++i) sums.push_back(sums_at(parts[i], group.rungs[i]));
    TubeSums all = parts.size() == 1 ? sums.front() : total(sums);
    std::vector<ChannelErrors> permitted(wavenumbers_.size());
    const auto exceeds = [&](std::size_t row) { return excess_of(all, all, row, {}) > 1.0; };
    if (options_.refines() && work_.permits && std::ranges::any_of(group.rows, exceeds)) permitted = work_.permits(all);
    std::map<std::vector<Rungs>, std::vector<std::size_t>> asking;
    for (const std::size_t row : group.rows) {
      const auto too_large = [&](const TubeSums& of) { return excess_of(of, all, row, permitted[row]); };
      std::vector<Rungs> rungs = group.rungs;
      if (options_.refines() && too_large(all) > 1.0)
        for (std::size_t i = 0; i < parts.size(); ++i)
          climb(parts[i], sums[i], static_cast<double>(parts.size()), too_large, rungs[i]);
      asking[std::move(rungs)].push_back(row);
    }
    std::vector<RowGroup> groups;
    for (auto& [rungs, rows] : asking)
      if (rungs == group.rungs)
        settle_at(rungs, rows, std::move(all), parts, result);
      else
        groups.push_back({rungs, std::move(rows)});
    return groups;
  }

 private:
  const TriangleMesh& mesh() const { return scene_.tracer.mesh(); }

  // How many times the error of a part of all sums is at a row what that row may have.
  double excess_of(const TubeSums& part, const TubeSums& all, std::size_t row, const ChannelErrors& permitted) const {
    return excess(all.total(row), part.error[row], look_.transmit == look_.receive, tolerance_, permitted);
  }

  // With a map its currents are those of its row.
  void settle_at(const std::vector<Rungs>& rungs, const std::vector<std::size_t>& rows, TubeSums sums,
                 std::vector<LookPart>& parts, TubeSums& result) const {
    if (!scene_.materials.empty()) add_truncated_tubes(sums);  // of conductors alone the number of bounces belongs to the model
    result.take(std::move(sums), rows);
    if (!work_.map || !options_.refines() || !std::ranges::binary_search(rows, work_.map->frequency_index())) return;
    for (std::size_t i = 0; i < parts.size(); ++i) trace(parts[i], rungs[i], 0.0, work_.map);
  }

  // Blocks of a part whose share of a row's error is too large climb by as many rungs as they need.
  template <class Excess>
  void climb(const LookPart& part, const TubeSums& sums, double parts, Excess too_large, Rungs& rungs) const {
    const double whole = too_large(sums) * parts, most = densest();
    if (whole <= 1.0 || !part.sampled(sums)) return;
    std::vector<BlockError> errors;
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      const TubeSums& block = part.blocks[i].at(rungs[i]);
      errors.push_back({part.sampled(block) ? too_large(block) * parts : 0.0, density_on(rungs[i], part.first_density) < most});
    }
    const auto [blocks, growth] = refinement(errors, whole, part.division.polygons ? order_of_polygons : order_of_cells);
    int rung = 0;
    for (const std::size_t i : blocks) rung = std::max(rung, rungs[i]);
    for (const double wanted = growth * density_on(rung, part.first_density);
         density_on(rung, part.first_density) < std::min(wanted, most);)
      ++rung;
    for (const std::size_t i : blocks) rungs[i] = rung;
  }

  // The blocks by rung; without those that are known there, unless a map is to have them.
  static std::map<int, std::vector<std::size_t>> by_rung(const LookPart& part, const Rungs& rungs, bool known_too) {
    std::map<int, std::vector<std::size_t>> blocks;
    for (std::size_t i = 0; i < rungs.size(); ++i)
      if (known_too || !part.blocks[i].contains(rungs[i])) blocks[rungs[i]].push_back(i);
    return blocks;
  }

  // Cells begin at the usual density; the few narrow tubes among polygons cost little, so they begin where they may do.
  double density_to_begin_with(const Division& division) const {
    const bool fixed = options_.per_wavelength >= options_.max_per_wavelength;
    if (!division.polygons || fixed) return first_density(options_);
    const double permitted = work_.permits ? std::max(options_.tolerance_db, permitted_at_first) : options_.tolerance_db;
    return std::min(density_for_a_decibel * std::pow(permitted, -1.0 / order_of_polygons), densest());
  }

  LaunchGrid grid_of(const LookPart& part, int rung) const {
    const double density = density_on(rung, part.first_density);
    return grid_of_look(mesh(), look_, wavelength_, rung == 0 ? density : std::min(density, densest()), options_.up);
  }

  double densest() const {
    return std::min(options_.max_per_wavelength, finest_grid * densest_grid(mesh(), look_, wavelength_, options_.up));
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

// What no group asks for any more: blocks never come down.
void drop_passed(std::vector<LookPart>& parts, const std::vector<RowGroup>& open) {
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t i = 0; i < parts[p].blocks.size() && !open.empty(); ++i) {
      std::map<int, TubeSums>& block = parts[p].blocks[i];
      const auto rung_of = [&](const RowGroup& group) { return group.rungs[p][i]; };
      block.erase(block.begin(), block.lower_bound(rung_of(*std::ranges::min_element(open, {}, rung_of))));
    }
}

}  // namespace

TubeSums sbr_scattering(const TubeScene& scene, const Look& look, std::span<const double> frequencies, const TubeOptions& options,
                        const TubeWork& work) {
  const LookTracer tracer(scene, look, frequencies, options, work);
  std::vector<LookPart> parts = tracer.parts();
  CurrentMap* const first_map = options.refines() ? nullptr : work.map;
  for (LookPart& part : parts) tracer.begin(part, work.share / static_cast<double>(parts.size()), first_map);
  TubeSums sums;
  std::vector<RowGroup> open{tracer.all_rows(parts)};
  while (!open.empty()) {
    const RowGroup group = std::move(open.back());
    open.pop_back();
    for (std::size_t i = 0; i < parts.size(); ++i) tracer.trace(parts[i], group.rungs[i], 0.0, nullptr);
    std::ranges::move(tracer.settle(group, parts, sums), std::back_inserter(open));
    drop_passed(parts, open);
  }
  sums.rays = 0;
  for (const LookPart& part : parts) sums.rays += part.rays;
  return sums;
}

double first_density(const TubeOptions& options) {
  return options.refines() ? std::min(options.per_wavelength, options.max_per_wavelength) : options.per_wavelength;
}

double look_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies) {
  // The batch, the sum of all batches, and the look's own result.
  const std::size_t held = std::min(tiles, tiles_per_batch(bounces, frequencies)) + 2;
  return static_cast<double>(held) * tile_sum_bytes(bounces, frequencies);
}

// Both the old blocks and the new ones of those that are refined.
double block_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies) {
  return 2.0 * static_cast<double>(std::min(tiles, most_blocks)) * tile_sum_bytes(bounces, frequencies);
}

// Beams of two bounces: most_tubes before a meeting, and after it twice as many, or more where facets divide them.
double tubes_between_sheets_bytes(std::size_t frequencies) {
  constexpr double beams = 4.0 * most_tubes;
  return beams *
         static_cast<double>(2 * sizeof(Footprint) + std::min(frequencies, most_frequencies_with_sheets) * sizeof(SpectralWave));
}

std::size_t tiles_of_look(const Tracer& tracer, const FaceTree& faces, const Look& look, std::span<const double> frequencies,
                          const TubeOptions& options, std::span<const Material> materials) {
  const double shortest = wavelength(std::ranges::max(frequencies));
  const auto of_cells = [&](double density) {
    return Tiling(grid_of_look(tracer.mesh(), look, shortest, density, options.up)).count();
  };
  if (options.mode == TubeMode::uniform) return of_cells(options.per_wavelength);
  const bool sheets = std::ranges::any_of(materials, &Material::transmits);
  const std::size_t count = faces.faces().size(), together = sheets ? faces_per_tile_with_sheets : faces_per_tile;
  std::size_t tiles = (count + together - 1) / together;
  if (count > faces_per_tile) tiles = std::max(tiles, of_cells(first_density(options)));  // where cells are cheaper
  if (any_solid(materials)) tiles = std::max(tiles, tracer.mesh().triangles.size() / triangles_per_solid_tile + 1);
  return tiles;
}

}  // namespace raytube
