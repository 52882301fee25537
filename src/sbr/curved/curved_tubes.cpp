#include "sbr/curved/curved_tubes.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/curved/curved_beam.h"
#include "scene/material.h"

namespace raytube {

namespace {

// A tube wider than this many wavelengths where it meets a surface ends there.
constexpr double most_width = 4.0;
// Probes along each side of a block.
constexpr std::uint32_t probes_across = 24;
// Cells of a block whose tubes are followed at a time: bounds memory however dense the grid is.
constexpr std::size_t most_cells = std::size_t{1} << 16;

// Tubes under way, all after the same number of bounces, and the rays that carry them on. A ray leaves the facet it met, its tube
// the surface behind it.
class CurvedTubes {
 public:
  CurvedTubes(const TubeLook& look, TubeSums& sums) : look_(look), band_(look.wavenumbers()), sums_(sums) {
    for (auto& sums_of_grid : coarse_sums_) sums_of_grid.resize(look.wavenumbers().size());
  }

  // Launches the cells' tubes and keeps those that a curved surface reflects.
  void launch(std::span<const glm::uvec2> cells) {
    tubes_.clear(), rays_.clear();
    for (const glm::uvec2& cell : cells) {
      const dvec2 at(look_.grid.u_center(cell.x), look_.grid.v_center(cell.y));
      tubes_.push_back({cell, look_.spherical ? launched_beam(look_.grid, look_.spherical->antennas().transmit, at)
                                              : launched_beam(look_.grid, look_.transmit, at)});
      rays_.push_back(look_.grid.ray(cell.x, cell.y));
    }
    find_hits();
    keep([&](const Tube&, const Hit& hit) { return look_.smooth->region(hit.triangle) != no_index; });
  }

  // The cells of the tubes that meet anything next.
  std::vector<glm::uvec2> meeting() {
    find_hits();
    std::vector<glm::uvec2> cells;
    for (std::size_t i = 0; i < tubes_.size(); ++i)
      if (hits_[i]) cells.push_back(tubes_[i].cell);
    return cells;
  }

  void follow() {
    for (int bounce = 1; !tubes_.empty(); ++bounce) {
      find_hits();
      if (bounce == look_.max_bounces) {
        for (const Hit& hit : hits_)
          if (hit) truncate(Truncation::bounces);
        break;
      }
      keep([&](const Tube& tube, const Hit& hit) {
        integrate(tube, bounce);
        if (look_.map) add_to_map(tube, hit.triangle, bounce);
        return true;
      });
    }
    if (!sums_.bounces.empty()) sums_.compare_with(coarse_sums_);
  }

 private:
  struct Tube {
    glm::uvec2 cell;
    CurvedBeam beam;
    CurvedFootprint footprint{};
  };

  void truncate(Truncation reason) { count_truncated(sums_.truncated[reason], look_.grid.du * look_.grid.dv, 1.0); }

  void find_hits() {
    hits_.resize(rays_.size());
    look_.tracer.closest_hits(rays_, hits_);
    sums_.rays += rays_.size();
  }

  // Reflects the tubes that met a surface and of which `take` says so.
  template <class Take>
  void keep(Take take) {
    const TriangleMesh& mesh = look_.tracer.mesh();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tubes_.size(); ++i) {
      const Hit hit = hits_[i];
      if (!hit) continue;
      const std::uint32_t patch = mesh.triangle_patch[hit.triangle];
      if (mesh.closed(hit.triangle) && glm::dot(mesh.patches[patch].normal, rays_[i].direction) > 0.0) {
        sums_.lose(rays_[i], hit.triangle, mesh);
        continue;
      }
      Tube tube = tubes_[i];
      const LocalSurface met = surface(tube.beam, hit.triangle);
      tube.footprint = curved_footprint(tube.beam, met, reception(met.point), look_.surfaces, mesh.patches[patch]);
      if (!take(tube, hit)) continue;
      if (is_too_wide(tube.footprint)) {
        truncate(Truncation::width);
        continue;
      }
      tube.beam = tube.footprint.outgoing;
      rays_[kept] = {rays_[i].origin + hit.distance * rays_[i].direction, tube.beam.direction, patch};
      tubes_[kept++] = tube;
    }
    tubes_.resize(kept);
    rays_.resize(kept);
  }

  Reception reception(const dvec3& point) const {
    return look_.spherical ? reception_at(look_.spherical->antennas().receive, point) : Reception{look_.receive};
  }

  // The curved surface unless it would send the tube into the facet; else the facet's plane.
  LocalSurface surface(const CurvedBeam& beam, std::uint32_t triangle) const {
    const Patch& patch = look_.tracer.mesh().patches[look_.tracer.mesh().triangle_patch[triangle]];
    const double facing = glm::dot(patch.normal, beam.direction);
    if (look_.smooth->region(triangle) != no_index) {
      const LocalSurface curved = look_.smooth->at(beam.base, beam.direction, triangle);
      if (glm::dot(reflected_direction(beam.direction, curved.normal), patch.normal) * facing < 0.0) return curved;
    }
    const double distance = (patch.offset - glm::dot(patch.normal, beam.base)) / facing;
    return {beam.base + distance * beam.direction, facing < 0.0 ? patch.normal : -patch.normal, glm::dmat3(0.0)};
  }

  // Beyond some wavelengths the derivatives at a tube's middle say little about its sides.
  bool is_too_wide(const CurvedFootprint& f) const {
    const double limit = most_width * 2.0 * pi / std::ranges::max(look_.wavenumbers());
    return glm::length(f.outgoing.along_u) * look_.grid.du > limit || glm::length(f.outgoing.along_v) * look_.grid.dv > limit;
  }

  void integrate(const Tube& tube, int bounce) {
    std::vector<ScatteringMatrix>& sums = sums_.at(bounce, look_.wavenumbers().size());
    ++sums_.hits[static_cast<std::size_t>(bounce)];
    const dvec2 cell(look_.grid.du, look_.grid.dv);
    sums_.meet(bounce, cell.x * cell.y, 1.0);
    if (look_.surfaces.any_rough()) sums_.add_incoherent(tube.footprint.outgoing.spectrum, cell.x * cell.y);
    add_far_fields(sums, tube.footprint, band_, cell);
    for (std::uint32_t grid = 0; grid < coarse_grids; ++grid)
      if (tube.cell.x % 3 == 1 - grid && tube.cell.y % 3 == 1 - grid)
        add_far_fields(coarse_sums_[grid], tube.footprint, band_, 3.0 * cell);
  }

  void add_to_map(const Tube& tube, std::uint32_t triangle, int bounce) {
    look_.map->set_bounce(bounce);
    ScatteringMatrix s;
    add_far_field(s, tube.footprint, look_.map->frequency_index(), look_.map->wavenumber(), {look_.grid.du, look_.grid.dv});
    const dvec2 at(look_.grid.u_center(tube.cell.x), look_.grid.v_center(tube.cell.y));
    look_.map->add({at, tube.footprint.outgoing.base, tube.footprint.phase}, triangle, s);
  }

  const TubeLook& look_;
  Band band_;
  TubeSums& sums_;
  std::vector<Tube> tubes_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::array<std::vector<ScatteringMatrix>, coarse_grids> coarse_sums_;  // [grid][frequency], all bounces
};

// Groups of stride x stride cells, probed by a ray each; a block is a square of them.
class Block {
 public:
  Block(const LaunchGrid& grid, std::uint32_t stride, const glm::uvec2& block) : grid_(grid), stride_(stride) {
    const glm::uvec2 groups = (glm::uvec2(grid.columns, grid.rows) + stride - 1u) / stride;
    first_ = block * probes_across;
    last_ = glm::min(first_ + probes_across, groups);
    // Groups beside the block matter too.
    low_ = glm::uvec2(first_.x - (first_.x > 0 ? 1 : 0), first_.y - (first_.y > 0 ? 1 : 0));
    high_ = glm::min(last_ + 1u, groups);
  }

  std::vector<glm::uvec2> probes() const {
    std::vector<glm::uvec2> cells;
    for (std::uint32_t row = low_.y; row < high_.y; ++row)
      for (std::uint32_t column = low_.x; column < high_.x; ++column)
        cells.push_back(glm::min(glm::uvec2(column, row) * stride_ + stride_ / 2, glm::uvec2(grid_.columns, grid_.rows) - 1u));
    return cells;
  }

  // Hands on, some at a time, all cells of the block's groups that are, or lie next to, the group of one of these cells.
  template <class Take>
  void cells_around(std::span<const glm::uvec2> met, Take take) const {
    const glm::uvec2 size = last_ - first_;
    std::vector<bool> chosen(std::size_t{size.x} * size.y);
    for (const glm::uvec2& cell : met) {
      const glm::ivec2 group = glm::ivec2(cell / stride_) - glm::ivec2(first_);
      for (int row = std::max(group.y - 1, 0); row <= std::min<int>(group.y + 1, static_cast<int>(size.y) - 1); ++row)
        for (int column = std::max(group.x - 1, 0); column <= std::min<int>(group.x + 1, static_cast<int>(size.x) - 1); ++column)
          chosen[std::size_t{size.x} * row + column] = true;
    }
    std::vector<glm::uvec2> cells;
    for (std::size_t group = 0; group < chosen.size(); ++group)
      if (chosen[group]) add_group(first_ + glm::uvec2(group % size.x, group / size.x), cells, take);
    take(cells);
  }

 private:
  template <class Take>
  void add_group(const glm::uvec2& group, std::vector<glm::uvec2>& cells, Take take) const {
    const glm::uvec2 begin = group * stride_, end = glm::min(begin + stride_, glm::uvec2(grid_.columns, grid_.rows));
    for (std::uint32_t row = begin.y; row < end.y; ++row)
      for (std::uint32_t column = begin.x; column < end.x; ++column) {
        cells.emplace_back(column, row);
        if (cells.size() < most_cells) continue;
        take(cells);
        cells.clear();
      }
  }

  const LaunchGrid& grid_;
  std::uint32_t stride_;
  glm::uvec2 first_, last_, low_, high_;  // groups of the block, and those that are probed
};

}  // namespace

CurvedBounces::CurvedBounces(const TubeLook& look) : look_(look) {
  const double half_wavelength = pi / std::ranges::max(look.wavenumbers());
  stride_ = std::max(1u, static_cast<std::uint32_t>(half_wavelength / std::max(look.grid.du, look.grid.dv)));
  const std::uint32_t side = probes_across * stride_;
  across_ = (look.grid.columns + side - 1) / side;
  down_ = (look.grid.rows + side - 1) / side;
}

TubeSums CurvedBounces::trace(std::size_t block) const {
  TubeSums sums;
  const Block here(look_.grid, stride_, {block % across_, block / across_});
  CurvedTubes tubes(look_, sums);
  tubes.launch(here.probes());
  here.cells_around(tubes.meeting(), [&](std::span<const glm::uvec2> cells) {
    tubes.launch(cells);
    tubes.follow();
  });
  return sums;
}

}  // namespace raytube
