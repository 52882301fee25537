#include "sbr/flat/polygon_currents.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/current_map.h"
#include "sbr/beams/polygon_integral.h"
#include "sbr/beams/spherical_look.h"

namespace raytube {

std::uint64_t cells_of(std::span<const CellBlock> blocks) {
  std::uint64_t cells = 0;
  for (const CellBlock& block : blocks) cells += block.cells();
  return cells;
}

void PolygonCurrents::add(TubeSums& to, std::uint32_t node, const VisiblePart& part, std::span<const CellBlock> blocks,
                          int bounce, CurrentMap* map) {
  std::vector<ScatteringMatrix>& sums = to.at(bounce, look_.wavenumbers().size());
  ++to.hits[static_cast<std::size_t>(bounce)];
  if (look_.spherical) return add_spherical(to, node, part, bounce, map);
  const auto radiate = [&](const Footprint& footprint, const VisiblePart& of, std::span<const CellBlock> under) {
    if (look_.clip) phase_integrals(footprint, band_, of.outline, integrals_);
    for (std::size_t f = 0; f < sums.size(); ++f) {
      const double k = look_.wavenumbers()[f];
      add_far_field(sums[f], footprint, f, k, look_.clip ? integrals_[f] : over_cells(footprint, k, under));
    }
    if (map) add_to_map(*map, footprint, of, under);
  };
  radiate(beams_.footprint(node), part, blocks);
  if (line_of_sight_) {
    for (ScreenedPart& screened : line_of_sight_->through_sheets(node, part.outline)) {
      if (!look_.clip) cells_under(look_.grid, screened.outline, screened_blocks_);
      radiate(beams_.footprint(screened.node), {part.face, std::move(screened.outline)}, screened_blocks_);
    }
  }
  add_to_estimates(to, beams_.footprint(node), part.outline, blocks);
}

void PolygonCurrents::add_spherical(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map) {
  add_spherical_part(to, node, part, bounce, map);
  if (!line_of_sight_) return;
  for (ScreenedPart& screened : line_of_sight_->through_sheets(node, part.outline))
    add_spherical_part(to, screened.node, {part.face, std::move(screened.outline)}, bounce, map);
}

void PolygonCurrents::add_spherical_part(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce,
                                         CurrentMap* map) const {
  const Beam& beam = beams_.beam(node);
  const Patch& plane = beams_.patch(node);
  if (!map) return look_.spherical->add(to, bounce, beam, plane, part.outline);
  const std::size_t f = map->frequency_index();
  const auto sum = [&] { return to.at(bounce, look_.wavenumbers().size())[f]; };
  const ScatteringMatrix before = sum();
  look_.spherical->add(to, bounce, beam, plane, part.outline);
  const SphericalLook at_frequency = look_.spherical->at_frequency(f);
  map->add(beam, part.outline, part.face, sum() - before, [&](const ConvexPolygon& of) {
    TubeSums alone;
    at_frequency.add(alone, 0, beam, plane, of);
    return alone.bounces[0][0];
  });
}

void PolygonCurrents::add_to_estimates(TubeSums& to, const Footprint& footprint, const ConvexPolygon& outline,
                                       std::span<const CellBlock> blocks) const {
  if (!look_.clip) count_staircase(to, footprint, outline);
  if (footprint.outgoing.spectrum && look_.surfaces.any_rough())
    to.add_incoherent(*footprint.outgoing.spectrum,
                      look_.clip ? area(outline) : static_cast<double>(cells_of(blocks)) * look_.grid.du * look_.grid.dv);
}

void PolygonCurrents::add_to_map(CurrentMap& map, const Footprint& footprint, const VisiblePart& part,
                                 std::span<const CellBlock> blocks) const {
  if (look_.clip) return map.add(footprint, part.outline, part.face);
  for (const CellBlock& block : blocks)
    for (std::uint32_t row = block.row_begin; row < block.row_end; ++row)
      for (std::uint32_t column = block.column_begin; column < block.column_end; ++column)
        map.add(footprint, cell_bounds(look_.grid, column, row),
                map.triangle_under(footprint.outgoing, part.face, look_.grid.ray_coordinates(column, row)));
}

// Cells stand for the polygon but for their stairs along its sides: each step is off by up to half a cell, h / sqrt(12) in the
// rms. The steps of a side along the grid are all alike, those of one across it independent.
void PolygonCurrents::count_staircase(TubeSums& to, const Footprint& footprint, const ConvexPolygon& outline) const {
  const double step = std::max(look_.grid.du, look_.grid.dv);
  to.pieces.resize(look_.wavenumbers().size());
  for (std::size_t f = 0; f < to.pieces.size(); ++f) {
    const double k = look_.wavenumbers()[f], per_area = k / (4.0 * pi) * footprint.area;
    double square = 0.0;  // of the launch area that is wrong [m^4]
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const dvec2 side = outline[(i + 1) % outline.size()].at - outline[i].at;
      const double alike = sinc(0.5 * k * glm::dot(dvec2(footprint.phase_u, footprint.phase_v), side)) * glm::length(side);
      square += step * step / 12.0 * (alike * alike + step * glm::length(side));
    }
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) to.pieces[f].squares[p][q] += std::pow(per_area * largest_weight(footprint, p, q), 2) * square;
  }
}

Complex PolygonCurrents::over_cells(const Footprint& footprint, double k, std::span<const CellBlock> blocks) const {
  Complex sum = 0.0;
  for (const CellBlock& block : blocks) {
    const LaunchGrid& grid = look_.grid;
    const dvec2 size{(block.column_end - block.column_begin) * grid.du, (block.row_end - block.row_begin) * grid.dv};
    const dvec2 low{grid.u_begin + block.column_begin * grid.du, grid.v_begin + block.row_begin * grid.dv};
    sum += phase_integral(footprint, k, low + 0.5 * size, size.x, size.y);
  }
  return sum;
}

}  // namespace raytube
