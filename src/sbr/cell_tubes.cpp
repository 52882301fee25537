#include "sbr/cell_tubes.h"

namespace raytube {

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

// Replaces the tubes by those that met a surface, sent on their way from there, and groups them in runs.
void CellTubes::reflect() {
  runs_.clear();
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
    const std::uint32_t node = beams_.child(beam, patch, {grid_.u_center(column), grid_.v_center(row)});
    const dvec3 point = rays_[i].origin + hit.distance * rays_[i].direction;
    tubes_[alive] = {column, row, node};
    rays_[alive] = {point, beams_.beam(node).direction, patch};
    extend_runs(tubes_[alive]);
    ++alive;
  }
  tubes_.resize(alive);
  rays_.resize(alive);
}

// Only a ray that slipped through an edge meets a closed body from inside.
bool CellTubes::is_leak(const Ray& ray, const Hit& hit, std::uint32_t patch) const {
  return tracer_.mesh().closed(hit.triangle) && glm::dot(tracer_.mesh().patches[patch].normal, ray.direction) > 0.0;
}

void CellTubes::extend_runs(const Tube& tube) {
  if (!runs_.empty()) {
    Run& last = runs_.back();
    if (last.node == tube.beam && last.row == tube.row && last.column_begin + last.columns == tube.column) {
      ++last.columns;
      return;
    }
  }
  runs_.push_back({tube.beam, tube.row, tube.column, 1});
}

void CellTubes::integrate(int bounce) {
  if (tubes_.empty()) return;
  std::vector<ScatteringMatrix>& sums = sums_.at(bounce, wavenumbers_.size());
  sums_.hits[static_cast<std::size_t>(bounce)] += tubes_.size();
  for (const Run& run : runs_) {
    const Footprint& footprint = beams_.footprint(run.node);
    const double width = run.columns * grid_.du;
    const dvec2 center{grid_.u_begin + run.column_begin * grid_.du + 0.5 * width, grid_.v_center(run.row)};
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      add_far_field(sums[f], footprint, wavenumbers_[f], phase_integral(footprint, wavenumbers_[f], center, width, grid_.dv));
  }
}

}  // namespace raytube
