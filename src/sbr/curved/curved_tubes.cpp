#include "sbr/curved/curved_tubes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/curved/curved_beam.h"
#include "sbr/visible/line_of_sight.h"
#include "scene/frequency_bands.h"
#include "scene/material.h"

namespace raytube {

namespace {

// A tube wider than this many wavelengths where it meets a surface ends there.
constexpr double most_width = 4.0;
// Probes along each side of a block.
constexpr std::uint32_t probes_across = 24;
// Cells of a block whose tubes are followed at a time: bounds memory however dense the grid is.
constexpr std::size_t most_cells = std::size_t{1} << 16, most_cells_with_sheets = most_tubes / 8;

// Tubes under way, all after the same number of bounces, and the rays that carry them on. A ray leaves the facet it met, its tube
// the surface behind it. Sheets are flat and divide a tube in two: what they transmit keeps its direction and wavefront.
class CurvedTubes {
 public:
  CurvedTubes(const TubeLook& look, TubeSums& sums) : look_(look), band_(look.wavenumbers()), sums_(sums) {
    for (auto& sums_of_grid : coarse_sums_) sums_of_grid.resize(look.wavenumbers().size());
    if (look.sheets) line_of_sight_.emplace(*look.sheets, look.tracer);
  }

  // The cells' tubes as launched.
  void launch(std::span<const glm::uvec2> cells) {
    tubes_.clear();
    for (const glm::uvec2& cell : cells) {
      const dvec2 at(look_.grid.u_center(cell.x), look_.grid.v_center(cell.y));
      tubes_.push_back({cell,
                        look_.spherical ? launched_beam(look_.grid, look_.spherical->antennas().transmit, at)
                                        : launched_beam(look_.grid, look_.transmit, at),
                        look_.grid.ray(cell.x, cell.y)});
      if (!look_.sheets) continue;
      CurvedBeam& beam = tubes_.back().beam;
      beam.spectrum = plain_spectrum(beam.field, look_.wavenumbers().size());
      tubes_.back().unit = raytube::amplitude(beam.spectrum);
    }
  }

  // The cells of the tubes that meet anything once a curved surface has reflected them.
  std::vector<glm::uvec2> meeting() {
    std::vector<glm::uvec2> cells;
    for (int bounce = 0; bounce <= look_.max_bounces && !tubes_.empty(); ++bounce)
      advance([&](const Tube& tube, const Hit& hit) {
        if (tube.beam.reflected)
          cells.push_back(tube.cell);
        else
          meet(tube, hit, bounce);
      });
    return cells;
  }

  void follow() {
    for (int bounce = 0; !tubes_.empty(); ++bounce)
      advance([&](const Tube& tube, const Hit& hit) {
        if (bounce < look_.max_bounces)
          meet(tube, hit, bounce);
        else if (tube.beam.reflected)
          truncate(tube, hit);
      });
    if (!sums_.bounces.empty()) sums_.compare_with(coarse_sums_);
  }

 private:
  // Until a curved surface reflects it a tube only goes on through sheets: what else the incident wave does is traced elsewhere.
  struct Tube {
    glm::uvec2 cell;
    CurvedBeam beam;
    Ray ray;
    double unit = 1.0;  // its field's magnitude as launched
    CurvedFootprint footprint{};
  };

  // Amplitude for unit incident waves; of conductors alone the number of bounces belongs to the model.
  double amplitude(const CurvedBeam& beam, double unit) const {
    return look_.sheets ? raytube::amplitude(beam.spectrum) / unit : 1.0;
  }
  double amplitude(const Tube& tube) const { return amplitude(tube.beam, tube.unit); }

  double cell_area() const { return look_.grid.du * look_.grid.dv; }

  void truncate(const Tube& tube, Truncation reason) { count_truncated(sums_.truncated[reason], cell_area(), amplitude(tube)); }

  void truncate(const Tube& tube, const Hit& hit) {
    if (!look_.sheets) return truncate(tube, Truncation::bounces);
    count_truncated(sums_.truncated[Truncation::bounces], look_.tracer, look_.surfaces,
                    {tube.ray, hit, cell_area(), amplitude(tube)});
  }

  // Calls meet(tube, hit) for all that meet a surface; those that this sends on are under way next.
  template <class Meet>
  void advance(Meet meet) {
    find_hits();
    next_.clear();
    for (std::size_t i = 0; i < tubes_.size(); ++i)
      if (hits_[i])
        meet(tubes_[i], hits_[i]);
      else
        sums_.lose_if_stray(tubes_[i].ray, look_.tracer.mesh());
    tubes_.swap(next_);
    if (look_.sheets)
      end_weakest(
          tubes_, most_tubes, [&](const Tube& tube) { return amplitude(tube); },
          [&](const Tube& tube) { truncate(tube, Truncation::number); });
  }

  void find_hits() {
    rays_.clear();
    for (const Tube& tube : tubes_) rays_.push_back(tube.ray);
    hits_.resize(rays_.size());
    look_.tracer.closest_hits(rays_, hits_);
    sums_.rays += rays_.size();
  }

  // Integrates the currents of a tube that curved surfaces have reflected, and sends on what leaves.
  void meet(Tube tube, const Hit& hit, int bounce) {
    const TriangleMesh& mesh = look_.tracer.mesh();
    const std::uint32_t patch = mesh.triangle_patch[hit.triangle];
    if (hit.from_inside) return sums_.lose(tube.ray, hit.triangle, mesh);
    const bool curved = look_.smooth->region(hit.triangle) != no_index;
    if (!tube.beam.reflected && !curved && !look_.surfaces.transmits(mesh.patches[patch].material)) return;
    const LocalSurface met = surface(tube.beam, hit.triangle);
    tube.footprint = curved_footprint(tube.beam, met, reception(met.point), look_.surfaces, mesh.patches[patch]);
    const Ray leaving{tube.ray.origin + hit.distance * tube.ray.direction, tube.beam.direction, patch};
    if (tube.beam.reflected) integrate(tube, leaving.origin, hit.triangle, bounce);
    go_through(tube, leaving);
    if (tube.beam.reflected || curved) reflect(tube, leaving);
  }

  void go_through(const Tube& tube, const Ray& leaving) {
    if (tube.footprint.transmitted.empty()) return;
    Tube through = tube;
    through.beam.spectrum = std::move(through.footprint.transmitted);
    through.footprint = {}, through.ray = leaving;
    if (amplitude(through) > least_amplitude) next_.push_back(std::move(through));
  }

  void reflect(Tube& tube, Ray leaving) {
    if (is_too_wide(tube.footprint)) return truncate(tube, Truncation::width);
    tube.beam = std::move(tube.footprint.outgoing);
    leaving.direction = tube.beam.direction;
    tube.ray = leaving;
    tube.footprint = {};
    if (amplitude(tube) > least_amplitude) next_.push_back(std::move(tube));
  }

  Reception reception(const dvec3& point) const {
    return look_.spherical ? reception_at(look_.spherical->antennas().receive, point) : Reception{look_.receive};
  }

  // The curved surface unless it would send the tube into the facet; else the facet's plane.
  LocalSurface surface(const CurvedBeam& beam, std::uint32_t triangle) const {
    const Patch& patch = look_.tracer.mesh().patch_of(triangle);
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
    const double limit = most_width * 2.0 * pi / sampling_wavenumber(look_.wavenumbers());
    return glm::length(f.outgoing.along_u) * look_.grid.du > limit || glm::length(f.outgoing.along_v) * look_.grid.dv > limit;
  }

  void integrate(const Tube& tube, const dvec3& point, std::uint32_t triangle, int bounce) {
    sums_.at(bounce, look_.wavenumbers().size());
    ++sums_.hits[static_cast<std::size_t>(bounce)];
    sums_.meet(bounce, cell_area(), amplitude(tube));
    if (look_.surfaces.any_rough()) sums_.add_incoherent(tube.footprint.outgoing.spectrum, cell_area());
    if (line_of_sight_) return integrate(tube, through_sheets(tube.footprint, point, triangle), triangle, bounce);
    integrate(tube, tube.footprint, triangle, bounce);
  }

  // As the receiver has the currents.
  void integrate(const Tube& tube, const CurvedFootprint& received, std::uint32_t triangle, int bounce) {
    std::vector<ScatteringMatrix>& sums = sums_.at(bounce, look_.wavenumbers().size());
    const dvec2 cell(look_.grid.du, look_.grid.dv);
    add_far_fields(sums, received, band_, cell);
    for (std::uint32_t grid = 0; grid < coarse_grids; ++grid)
      if (tube.cell.x % 3 == 1 - grid && tube.cell.y % 3 == 1 - grid)
        add_far_fields(coarse_sums_[grid], received, band_, 3.0 * cell);
    if (look_.map) add_to_map(tube.cell, received, triangle, bounce);
  }

  // As the receiver has the currents behind every sheet on the way to it from the facet's point.
  CurvedFootprint through_sheets(CurvedFootprint f, const dvec3& point, std::uint32_t triangle) {
    const TriangleMesh& mesh = look_.tracer.mesh();
    const SphericalBasis basis = reception(point).basis,
                         antenna{basis.radial, glm::normalize(basis.theta_hat), glm::normalize(basis.phi_hat)};
    line_of_sight_->add(0, 0, point, mesh.triangle_patch[triangle]);
    sums_.rays += line_of_sight_->follow([&](const RayLineOfSight::Line& line) {
      const Patch& met = mesh.patches[line.ray.source_patch];
      if (!look_.surfaces.transmits(met.material)) return;
      for (std::size_t i = 0; i < f.outgoing.spectrum.size(); ++i) {
        ChannelWeights& weight = f.outgoing.spectrum[i].weight;
        weight = received_through(through_screen(look_.surfaces, met, i, antenna), weight);
      }
    });
    return f;
  }

  void add_to_map(const glm::uvec2& cell, const CurvedFootprint& footprint, std::uint32_t triangle, int bounce) {
    ScatteringMatrix s;
    add_far_field(s, footprint, look_.map->frequency_index(), look_.map->wavenumber(), {look_.grid.du, look_.grid.dv});
    const dvec2 at(look_.grid.u_center(cell.x), look_.grid.v_center(cell.y));
    look_.map->add(bounce, {at, footprint.outgoing.base, footprint.phase}, triangle, s);
  }

  const TubeLook& look_;
  Band band_;
  TubeSums& sums_;
  std::optional<RayLineOfSight> line_of_sight_;  // where there are sheets
  std::vector<Tube> tubes_, next_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::array<std::vector<ScatteringMatrix>, coarse_grids> coarse_sums_;  // [grid][frequency], all bounces
};

// Groups of stride x stride cells, probed by a ray each; a block is a square of them.
class Block {
 public:
  Block(const LaunchGrid& grid, std::uint32_t stride, const glm::uvec2& block, std::size_t together)
      : grid_(grid), stride_(stride), together_(together) {
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
        if (cells.size() < together_) continue;
        take(cells);
        cells.clear();
      }
  }

  const LaunchGrid& grid_;
  std::uint32_t stride_;
  std::size_t together_;                  // cells that are handed on
  glm::uvec2 first_, last_, low_, high_;  // groups of the block, and those that are probed
};

}  // namespace

CurvedBounces::CurvedBounces(const TubeLook& look) : look_(look) {
  const double half_wavelength = pi / sampling_wavenumber(look.wavenumbers());
  stride_ = std::max(1u, static_cast<std::uint32_t>(half_wavelength / std::max(look.grid.du, look.grid.dv)));
  const std::uint32_t side = probes_across * stride_;
  across_ = (look.grid.columns + side - 1) / side;
  down_ = (look.grid.rows + side - 1) / side;
}

TubeSums CurvedBounces::trace(std::size_t block) const {
  TubeSums sums;
  const Block here(look_.grid, stride_, {block % across_, block / across_}, look_.sheets ? most_cells_with_sheets : most_cells);
  CurvedTubes tubes(look_, sums);
  tubes.launch(here.probes());
  here.cells_around(tubes.meeting(), [&](std::span<const glm::uvec2> cells) {
    tubes.launch(cells);
    tubes.follow();
  });
  return sums;
}

}  // namespace raytube
