#include "sbr/tile.h"

#include "sbr/beam_tree.h"

namespace raytube {

namespace {

// A tube under way: its launch cell and the beam it travels in.
struct Tube {
  std::uint32_t column, row, beam;
};

// Neighbouring cells of a row whose tubes share a footprint: together one wider tube, integrated in one closed form.
struct Run {
  std::uint32_t node, row, column_begin, columns;
};

class TileTrace {
 public:
  TileTrace(const Tracer& tracer, const LaunchGrid& grid, const Tile& tile, const SphericalBasis& transmit,
            const SphericalBasis& receive, std::span<const double> wavenumbers)
      : tracer_(tracer),
        grid_(grid),
        middle_{0.5 * (grid.u_center(tile.column_begin) + grid.u_center(tile.column_end - 1)),
                0.5 * (grid.v_center(tile.row_begin) + grid.v_center(tile.row_end - 1))},
        wavenumbers_(wavenumbers),
        beams_(tracer.mesh(), receive, incident_beam(grid, transmit, middle_)) {
    launch(tile);
  }

  TubeSums run(int max_bounces) {
    for (int bounce = 0; !tubes_.empty(); ++bounce) {
      hits_.resize(rays_.size());
      tracer_.closest_hits(rays_, hits_);
      sums_.rays += rays_.size();
      if (bounce == max_bounces) {
        for (const Hit& hit : hits_) sums_.tubes_cut += hit ? 1 : 0;
        break;
      }
      reflect();
      integrate();
    }
    return std::move(sums_);
  }

 private:
  void launch(const Tile& tile) {
    const std::size_t cells = std::size_t{tile.row_end - tile.row_begin} * (tile.column_end - tile.column_begin);
    tubes_.reserve(cells);
    rays_.reserve(cells);
    hits_.reserve(cells);
    for (std::uint32_t row = tile.row_begin; row < tile.row_end; ++row)
      for (std::uint32_t column = tile.column_begin; column < tile.column_end; ++column) {
        tubes_.push_back({column, row, BeamTree::root});
        rays_.push_back(grid_.ray(column, row));
      }
    sums_.tubes = tubes_.size();
  }

  // Replaces the tubes by those that met a surface, sent on their way from there, and groups them in runs.
  void reflect() {
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
      const std::uint32_t node = beams_.child(tubes_[i].beam, patch, middle_);
      const dvec3 point = rays_[i].origin + hit.distance * rays_[i].direction;
      tubes_[alive] = {tubes_[i].column, tubes_[i].row, node};
      rays_[alive] = {point, beams_.beam(node).direction, patch};
      extend_runs(tubes_[alive]);
      ++alive;
    }
    tubes_.resize(alive);
    rays_.resize(alive);
  }

  // Only a ray that slipped through an edge meets a closed body from inside.
  bool is_leak(const Ray& ray, const Hit& hit, std::uint32_t patch) const {
    return tracer_.mesh().closed(hit.triangle) && glm::dot(tracer_.mesh().patches[patch].normal, ray.direction) > 0.0;
  }

  void extend_runs(const Tube& tube) {
    if (!runs_.empty()) {
      Run& last = runs_.back();
      if (last.node == tube.beam && last.row == tube.row && last.column_begin + last.columns == tube.column) {
        ++last.columns;
        return;
      }
    }
    runs_.push_back({tube.beam, tube.row, tube.column, 1});
  }

  void integrate() {
    if (tubes_.empty()) return;
    sums_.hits.push_back(tubes_.size());
    std::vector<ScatteringMatrix>& sums = sums_.bounces.emplace_back(wavenumbers_.size());
    for (const Run& run : runs_) {
      const Footprint& footprint = beams_.footprint(run.node);
      const double width = run.columns * grid_.du;
      const dvec2 center{grid_.u_begin + run.column_begin * grid_.du + 0.5 * width, grid_.v_center(run.row)};
      for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
        add_far_field(sums[f], footprint, wavenumbers_[f], phase_integral(footprint, wavenumbers_[f], center, width, grid_.dv));
    }
  }

  const Tracer& tracer_;
  const LaunchGrid& grid_;
  dvec2 middle_;  // of the tile, in launch coordinates
  std::span<const double> wavenumbers_;
  BeamTree beams_;
  std::vector<Tube> tubes_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<Run> runs_;
  TubeSums sums_;
};

template <class Values>
void add_at(Values& sum, std::size_t index, const typename Values::value_type& value) {
  if (sum.size() <= index) sum.resize(index + 1);
  sum[index] += value;
}

}  // namespace

void TubeSums::add(const TubeSums& other) {
  for (std::size_t b = 0; b < other.bounces.size(); ++b) {
    if (bounces.size() <= b) bounces.emplace_back(other.bounces[b].size());
    for (std::size_t f = 0; f < other.bounces[b].size(); ++f) bounces[b][f] += other.bounces[b][f];
    add_at(hits, b, other.hits[b]);
  }
  tubes += other.tubes;
  rays += other.rays;
  lost_rays += other.lost_rays;
  tubes_cut += other.tubes_cut;
  sliver_area += other.sliver_area;
}

TubeSums trace_tile(const Tracer& tracer, const LaunchGrid& grid, const Tile& tile, const SphericalBasis& transmit,
                    const SphericalBasis& receive, std::span<const double> wavenumbers, int max_bounces) {
  return TileTrace(tracer, grid, tile, transmit, receive, wavenumbers).run(max_bounces);
}

}  // namespace raytube
