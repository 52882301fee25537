#include "sbr/cell_tubes.h"

#include <algorithm>

namespace raytube {

namespace {

// Cells of the coarse grid along one side of the launch plane.
constexpr std::uint32_t coarseness = 3;

bool stands_for_group(std::uint32_t index, std::uint32_t count) {
  const std::uint32_t place = index % coarseness;
  return place == 1 || (place == 0 && index + 1 == count);
}

struct Group {
  std::uint32_t begin, end;
};

Group group_of(std::uint32_t index, std::uint32_t count) {
  const std::uint32_t begin = index - index % coarseness;
  return {begin, std::min(begin + coarseness, count)};
}

}  // namespace

void CellTubes::reserve(std::size_t count) {
  tubes_.reserve(count);
  rays_.reserve(count);
  hits_.reserve(count);
}

void CellTubes::launch(std::uint32_t column, std::uint32_t row) {
  tubes_.push_back({column, row, BeamTree::root});
  rays_.push_back(grid_.ray(column, row));
}

void CellTubes::add(std::uint32_t column, std::uint32_t row, std::uint32_t beam, std::uint32_t patch) {
  const Beam& b = beams_.beam(beam);
  const dvec2 step = grid_.ray_place(column, row) - b.anchor;
  tubes_.push_back({column, row, beam});
  rays_.push_back({b.base + step.x * b.along_u + step.y * b.along_v, b.direction, patch});
}

void CellTubes::advance(int bounce, int max_bounces) {
  hits_.resize(rays_.size());
  tracer_.closest_hits(rays_, hits_);
  sums_.rays += rays_.size();
  if (bounce < max_bounces) {
    reflect();
    integrate(bounce);
    return;
  }
  for (const Hit& hit : hits_) sums_.tubes_cut += hit ? 1 : 0;
  tubes_.clear();
  rays_.clear();
}

// Replaces the tubes by those that met a surface, sent on their way from there.
void CellTubes::reflect() {
  std::size_t alive = 0;
  for (std::size_t i = 0; i < tubes_.size(); ++i) {
    const Hit hit = hits_[i];
    if (!hit) continue;
    const std::uint32_t patch = tracer_.mesh().triangle_patch[hit.triangle];
    if (is_leak(rays_[i], hit, patch)) {
      ++sums_.lost_rays;
      continue;
    }
    const auto [column, row, beam] = tubes_[i];
    if (smooth_ && beam == BeamTree::root && smooth_->region(hit.triangle) != no_index) continue;
    const std::uint32_t node = beams_.child(beam, patch, {grid_.u_center(column), grid_.v_center(row)});
    const dvec3 point = rays_[i].origin + hit.distance * rays_[i].direction;
    tubes_[alive] = {column, row, node};
    rays_[alive] = {point, beams_.beam(node).direction, patch};
    ++alive;
  }
  tubes_.resize(alive);
  rays_.resize(alive);
}

// Only a ray that slipped through an edge meets a closed body from inside.
bool CellTubes::is_leak(const Ray& ray, const Hit& hit, std::uint32_t patch) const {
  return tracer_.mesh().closed(hit.triangle) && glm::dot(tracer_.mesh().patches[patch].normal, ray.direction) > 0.0;
}

void CellTubes::find_runs() {
  runs_.clear();
  for (const auto& [column, row, node] : tubes_) extend(runs_, node, {column, column + 1, row, row + 1});
}

void CellTubes::find_coarse_runs() {
  runs_.clear();
  for (const auto& [column, row, node] : tubes_) {
    if (!stands_for_group(row, grid_.rows) || !stands_for_group(column, grid_.columns)) continue;
    const Group across = group_of(column, grid_.columns), down = group_of(row, grid_.rows);
    extend(runs_, node, {across.begin, across.end, down.begin, down.end});
  }
}

void CellTubes::extend(std::vector<Run>& runs, std::uint32_t node, const CellBlock& cells) {
  if (!runs.empty()) {
    Run& last = runs.back();
    if (last.node == node && last.cells.row_begin == cells.row_begin && last.cells.column_end == cells.column_begin) {
      last.cells.column_end = cells.column_end;
      return;
    }
  }
  runs.push_back({node, cells});
}

void CellTubes::integrate(int bounce) {
  if (tubes_.empty()) return;
  std::vector<ScatteringMatrix>& sums = sums_.at(bounce, wavenumbers_.size());
  sums_.hits[static_cast<std::size_t>(bounce)] += tubes_.size();
  find_runs();
  integrate_runs(sums);
  if (coarse_sums_.empty()) return;
  find_coarse_runs();
  integrate_runs(coarse_sums_);
}

void CellTubes::integrate_runs(std::vector<ScatteringMatrix>& sums) const {
  for (const auto& [node, cells] : runs_) {
    const Footprint& footprint = beams_.footprint(node);
    const dvec2 size{(cells.column_end - cells.column_begin) * grid_.du, (cells.row_end - cells.row_begin) * grid_.dv};
    const dvec2 low{grid_.u_begin + cells.column_begin * grid_.du, grid_.v_begin + cells.row_begin * grid_.dv};
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      add_far_field(sums[f], footprint, wavenumbers_[f],
                    phase_integral(footprint, wavenumbers_[f], low + 0.5 * size, size.x, size.y));
  }
}

}  // namespace raytube
