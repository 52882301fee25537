#include "sbr/flat/tile_tracer.h"

#include <algorithm>
#include <utility>

#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/flat/coverage.h"

namespace raytube {

namespace {

// Cells of a coarse grid along one side of the launch plane.
constexpr std::uint32_t coarseness = 3;

struct Group {
  std::uint32_t begin, end;
  bool empty() const { return begin == end; }
};

// The group that a cell stands for among [begin, end), in the coarse grid moved by so many cells; `begin` is
// divisible by three.
Group group_of(std::uint32_t index, std::uint32_t moved, std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t in_group = (index + moved) % coarseness;
  if (in_group != 1 && !(in_group == 0 && index + 1 == end)) return {};
  return {index - std::min(in_group, index - begin), std::min(index - in_group + coarseness, end)};
}

dvec2 middle(const LaunchGrid& grid, const CellBlock& tile) {
  return {0.5 * (grid.u_center(tile.column_begin) + grid.u_center(tile.column_end - 1)),
          0.5 * (grid.v_center(tile.row_begin) + grid.v_center(tile.row_end - 1))};
}

}  // namespace

TileTracer::TileTracer(const TubeLook& look)
    : look_(look),
      grid_(look.grid),
      beams_(look.tracer.mesh(), look.surfaces, look.receive, incident_beam(look.grid, look.transmit, dvec2(0.0))),
      far_fields_(look.wavenumbers()) {
  if (look.sheets) line_of_sight_.emplace(*look.sheets, look.tracer);
}

TubeSums TileTracer::trace(const CellBlock& tile) {
  sums_ = {};
  sums_.tubes = tile.cells();
  tile_ = tile;
  for (std::vector<ScatteringMatrix>& sums : coarse_sums_) sums.assign(look_.wavenumbers().size(), {});
  beams_.restart(incident_beam(grid_, look_.transmit, middle(grid_, tile)));
  launch();
  if (look_.convexity.no_reflection) {
    advance(0);
    clear();
  }
  for (int bounce = 0; !tubes_.empty(); ++bounce) {
    beams_.next_bounce();
    advance(bounce);
  }
  sums_.compare_with(coarse_sums_);
  return std::move(sums_);
}

void TileTracer::clear() {
  tubes_.clear();
  rays_.clear();
}

void TileTracer::launch() {
  const Coverage coverage(look_.skip ? &look_.faces : nullptr, grid_, tile_);
  sums_.empty_cells = coverage.empty_cells();
  for (std::uint32_t row = tile_.row_begin; row < tile_.row_end; ++row)
    for (auto span = coverage.next(row, tile_.column_begin); span.begin < span.end; span = coverage.next(row, span.end))
      for (std::uint32_t column = span.begin; column < span.end; ++column) {
        tubes_.push_back({column, row, BeamTree::root});
        rays_.push_back(grid_.ray(column, row));
      }
}

Ray TileTracer::reflected_ray(std::uint32_t column, std::uint32_t row, std::uint32_t beam, std::uint32_t patch) const {
  return tube_ray(beams_.beam(beam), grid_.ray_coordinates(column, row), &look_.tracer.mesh().patches[patch], patch);
}

void TileTracer::advance(int bounce) {
  sums_.rays += rays_.size();
  hits_.resize(rays_.size());
  look_.tracer.closest_hits(rays_, hits_);
  if (bounce == look_.max_bounces) return truncate();
  reflect(bounce);
  integrate(bounce);
  send_on();
  end_weakest();
}

void TileTracer::truncate() {
  for (std::size_t i = 0; i < tubes_.size(); ++i)
    if (hits_[i])
      count_truncated(sums_.truncated[Truncation::bounces], look_.tracer, beams_.surfaces(),
                      {rays_[i], hits_[i], grid_.du * grid_.dv, beams_.amplitude(tubes_[i].beam)});
  clear();
}

void TileTracer::end_weakest() {
  if (!beams_.spectral() || tubes_.size() <= most_tubes) return;
  const auto amplitude = [&](const Tube& tube) { return beams_.amplitude(tube.beam); };
  raytube::end_weakest(tubes_, most_tubes, amplitude, [&](const Tube& tube) {
    count_truncated(sums_.truncated[Truncation::number], grid_.du * grid_.dv, amplitude(tube));
  });
  rays_.clear();
  for (const Tube& tube : tubes_) rays_.push_back(reflected_ray(tube.column, tube.row, tube.beam, beams_.patch_index(tube.beam)));
}

// Replaces the tubes by those that met a surface, sent on their way from there.
void TileTracer::reflect(int bounce) {
  const TriangleMesh& mesh = look_.tracer.mesh();
  std::size_t alive = 0;
  for (std::size_t i = 0; i < tubes_.size(); ++i) {
    const Hit hit = hits_[i];
    if (!hit) continue;
    const auto [column, row, beam] = tubes_[i];
    if (look_.smooth && !beams_.is_reflected(beam) && look_.smooth->region(hit.triangle) != no_index) continue;
    const std::uint32_t patch = mesh.triangle_patch[hit.triangle],
                        node = beams_.child(beam, patch, {grid_.u_center(column), grid_.v_center(row)});
    if (hit.from_inside) {
      sums_.lose(rays_[i], hit.triangle, mesh);
      continue;
    }
    sums_.meet(bounce, grid_.du * grid_.dv, beams_.amplitude(beam));
    tubes_[alive] = {column, row, node};
    hits_[alive] = hit;
    rays_[alive] = reflected_ray(column, row, node, patch);
    ++alive;
  }
  tubes_.resize(alive);
  rays_.resize(alive);
}

// Ends the tubes of which nothing was reflected and adds those that go on behind a sheet.
void TileTracer::send_on() {
  if (!beams_.spectral()) return;
  const std::size_t count = tubes_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [column, row, node] = tubes_[i];
    const std::uint32_t through = beams_.through(node);
    if (through == no_index) continue;
    tubes_.push_back({column, row, through});
    rays_.push_back(reflected_ray(column, row, through, beams_.patch_index(through)));
  }
  std::size_t alive = 0;
  for (std::size_t i = 0; i < tubes_.size(); ++i) {
    if (!beams_.is_lit(tubes_[i].beam)) continue;
    tubes_[alive] = tubes_[i];
    rays_[alive++] = rays_[i];
  }
  tubes_.resize(alive);
  rays_.resize(alive);
}

void TileTracer::find_screened_tubes(int bounce) {
  screened_.clear();
  if (!line_of_sight_) return;
  for (std::uint32_t i = 0; i < tubes_.size(); ++i)
    line_of_sight_->add(i, tubes_[i].beam, rays_[i].origin, rays_[i].source_patch);
  sums_.rays += line_of_sight_->through_sheets(beams_, [&](std::uint32_t i, std::uint32_t node) {
    const Tube& tube = tubes_[i];
    screened_.push_back({tube.column, tube.row, node});
    if (look_.map) add_to_map(bounce, screened_.back(), hits_[i].triangle);
  });
}

void TileTracer::find_runs(std::span<const Tube> tubes) {
  runs_.clear();
  for (const auto& [column, row, node] : tubes)
    extend({node, {column, column + 1, row, row + 1}, grid_.ray_coordinates(column, row)});
}

void TileTracer::find_coarse_runs(std::span<const Tube> tubes, std::uint32_t grid) {
  runs_.clear();
  for (const auto& [column, row, node] : tubes) {
    const Group down = group_of(row, grid, tile_.row_begin, tile_.row_end);
    if (down.empty()) continue;
    const Group across = group_of(column, grid, tile_.column_begin, tile_.column_end);
    if (across.empty()) continue;
    extend({node, {across.begin, across.end, down.begin, down.end}, grid_.ray_coordinates(column, row)});
  }
}

void TileTracer::extend(const Run& next) {
  if (!runs_.empty() && !look_.spherical) {
    auto& [node, cells, ray_at] = runs_.back();
    if (node == next.node && cells.row_begin == next.cells.row_begin && cells.column_end == next.cells.column_begin) {
      cells.column_end = next.cells.column_end;
      return;
    }
  }
  runs_.push_back(next);
}

void TileTracer::integrate(int bounce) {
  if (tubes_.empty()) return;
  std::vector<ScatteringMatrix>& sums = sums_.at(bounce, look_.wavenumbers().size());
  sums_.hits[static_cast<std::size_t>(bounce)] += tubes_.size();
  find_screened_tubes(bounce);
  add_incoherent();
  for (std::size_t i = 0; look_.map && i < tubes_.size(); ++i) add_to_map(bounce, tubes_[i], hits_[i].triangle);
  for (const std::span<const Tube> tubes : {std::span<const Tube>(tubes_), std::span<const Tube>(screened_)}) {
    if (tubes.empty()) continue;
    find_runs(tubes);
    integrate_runs(sums);
    for (std::uint32_t grid = 0; grid < coarse_grids; ++grid) {
      find_coarse_runs(tubes, grid);
      integrate_runs(coarse_sums_[grid]);
    }
  }
}

void TileTracer::add_incoherent() {
  if (!beams_.spectral() || !beams_.surfaces().any_rough()) return;
  const double cell = grid_.du * grid_.dv;
  for (const auto& [column, row, node] : tubes_) {
    const Beam& beam = beams_.beam(node);
    if (beam.spectrum) sums_.add_incoherent(*beam.spectrum, cell);
    if (beam.met) look_.spherical->add_incoherent(sums_, beam, beams_.patch(node), grid_.ray_coordinates(column, row), cell);
  }
}

void TileTracer::add_to_map(int bounce, const Tube& tube, std::uint32_t triangle) {
  const Bounds cell = cell_bounds(grid_, tube.column, tube.row);
  if (!look_.spherical) return look_.map->add(bounce, beams_.footprint(tube.beam), cell, triangle);
  const dvec2 at = grid_.ray_coordinates(tube.column, tube.row);
  Spectrum spectrum;
  look_.map->add(bounce, look_.spherical->footprint(beams_.beam(tube.beam), beams_.patch(tube.beam), at, spectrum), cell,
                 triangle);
}

// Current and phase gradient of a spherical wave are those where the ray met the surface: from the middle of its cells none may
// lead there, at grazing not even to the plane.
void TileTracer::integrate_runs(std::vector<ScatteringMatrix>& sums) {
  Spectrum spectrum;
  for (const auto& [node, cells, ray_at] : runs_) {
    const dvec2 size{(cells.column_end - cells.column_begin) * grid_.du, (cells.row_end - cells.row_begin) * grid_.dv};
    const dvec2 low{grid_.u_begin + cells.column_begin * grid_.du, grid_.v_begin + cells.row_begin * grid_.dv};
    const dvec2 center = low + 0.5 * size;
    if (!look_.spherical) {
      far_fields_.add(beams_.footprint(node), center, size);
      continue;
    }
    const Footprint footprint = look_.spherical->footprint(beams_.beam(node), beams_.patch(node), ray_at, spectrum);
    if (!footprint.outgoing.spectrum) {
      far_fields_.add(footprint, center, size);
      continue;
    }
    for (std::size_t f = 0; f < sums.size(); ++f) {
      const double k = beams_.surfaces().wavenumbers[f];
      add_far_field(sums[f], footprint, f, k, phase_integral(footprint, k, center, size.x, size.y));
    }
  }
  far_fields_.add_up(sums);
}

}  // namespace raytube
