#include "solve/look_solver.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>

#include "gtd/ray_fields.h"
#include "plan/phase_reference.h"
#include "sbr/beams/current_map.h"
#include "sbr/sbr.h"
#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"
#include "solve/scheduler.h"

namespace raytube {

namespace {

void make_look_reciprocal(LookResult& look) {
  for (std::vector<ScatteringMatrix>& bounce : look.tubes.bounces) make_reciprocal(bounce);
  for (ChannelErrors& error : look.tubes.error) error[0][1] = error[1][0] = 0.5 * (error[0][1] + error[1][0]);
  for (Contribution& part : look.mechanisms) {
    for (std::vector<ScatteringMatrix>& column : part.s) make_reciprocal(column);
    for (ChannelErrors& error : part.error) error[0][1] = error[1][0] = 0.5 * (error[0][1] + error[1][0]);
  }
}

}  // namespace

// Computes looks at the frequencies of one band. Refers to the plan and its model uncertainty.
class BandSolver {
 public:
  BandSolver(const SolvePlan& plan, std::size_t band, const ModelUncertainty& model)
      : scene_(plan, plan.bands[band], model.curved_parts()), band_(band), model_(model) {
    for (const MechanismEntry& entry : plan.mechanisms) mechanisms_.push_back(entry.make(scene_));
    if (plan.rays())
      ray_fields_.emplace(plan.target.tracer, scene_.materials, plan.target.wedges, plan.ray_range, plan.sweep.radar,
                          plan.max_bounces());
  }

  LookResult solve(const Look& look, Progress& progress, double share) const {
    const SolvePlan& plan = scene_.plan;
    if (plan.rays()) return rays(look, progress, share);
    LookResult result;
    result.tubes = trace_tubes(look, progress, first_tubes_share * share, nullptr);
    LookSink sink;
    result.mechanisms = run_mechanisms({look, result.tubes}, sink, progress, share);
    result.met = {result.tubes.met};
    result.truncated = {result.tubes.truncated.sigma()};
    if (!plan.sweep.bistatic) make_look_reciprocal(result);
    return result;
  }

  void solve_image(const Look& look, std::size_t frequency_index, const ImageLattice& lattice, Progress& progress,
                   LookImage& image) const {
    const std::vector<double>& frequencies = scene_.band.frequencies;
    const FaceTree& faces = scene_.plan.target.faces;
    image.cells.resize(lattice.cells()), image.triangles.resize(faces.mesh().triangles.size());
    const CurrentSink take = [&](const CurrentPiece& of) {
      image.cells[lattice.index(lattice.at(of.at))] += of.s;
      image.triangles[of.triangle] += of.s;
    };
    CurrentMap map(faces, lattice, frequency_index, wavenumber(frequencies[frequency_index]), take);
    const TubeSums tubes = trace_tubes(look, progress, 1.0, &map);
    image.edges = edge_pieces(look, tubes, {frequency_index, lattice}).pieces;
  }

  void solve_pieces(const Look& look, const ImageLattice& currents, const ImageLattice& edges, Progress& progress,
                    const PieceSink& sink, const std::optional<double>& mirror) const {
    const CurrentSink take = [&](const CurrentPiece& of) {
      sink({of.place, of.s, std::min<std::size_t>(of.bounce, tube_pieces.size() - 1), of.triangle});
    };
    CurrentMap map(scene_.plan.target.faces, currents, 0, wavenumber(scene_.band.frequencies.front()), take, true, mirror);
    const TubeSums tubes = trace_tubes(look, progress, 1.0, &map);
    const ImageRequest request = edge_pieces(look, tubes, {0, edges, !mirror});
    for (std::size_t i = 0; i < request.pieces.size(); ++i) {
      const ImageEdge& edge = request.pieces[i];
      dvec3 place = 0.5 * (edge.begin + edge.end);
      if (mirror) place.z = *mirror;
      sink({place, edge.s, tube_pieces.size() + request.mechanisms[i], {}});
    }
  }

  std::vector<SurfaceRay> surface_rays(const Look& look) const {
    std::vector<SurfaceArrival> arrivals;
    std::vector<SurfaceRay> rays;
    for (const std::unique_ptr<Mechanism>& mechanism : mechanisms_)
      if (mechanism) mechanism->trace(look, arrivals, rays);
    return rays;
  }

  std::vector<double> edge_lengths() const { return scene_.edges.radiating_lengths(); }

 private:
  std::vector<ChannelErrors> permitted_errors(const Look& look, const TubeSums& tubes) const {
    std::vector<ChannelErrors> errors = model_.at_least(look, band_, tubes);
    for (ChannelErrors& row : errors) row = scaled(row, scene_.plan.tubes.model_share);
    return errors;
  }

  TubeSums trace_tubes(const Look& look, Progress& progress, double share, CurrentMap* map) const {
    TubeWork work{progress, share, map};
    if (scene_.plan.tubes.model_share > 0.0) work.permits = [&](const TubeSums& tubes) { return permitted_errors(look, tubes); };
    return sbr_scattering(scene_.tubes, look, scene_.band.frequencies, scene_.plan.tubes, work);
  }

  ImageRequest edge_pieces(const Look& look, const TubeSums& tubes, ImageRequest request) const {
    LookSink sink;
    sink.image = &request;
    Progress silent({});
    run_mechanisms({look, tubes}, sink, silent, 0.0);
    return request;
  }

  std::vector<Contribution> run_mechanisms(const TracedLook& look, LookSink& sink, Progress& progress, double share) const {
    const double step = (1.0 - first_tubes_share) * share / static_cast<double>(mechanisms_.size() + 1);
    std::vector<Contribution> all;
    progress.add(step);
    for (std::size_t i = 0; i < mechanisms_.size(); ++i) {
      all.push_back(run(i, look, all, sink));
      progress.add(step);
    }
    return all;
  }

  Contribution run(std::size_t i, const TracedLook& look, const std::vector<Contribution>& before, LookSink& sink) const {
    if (!mechanisms_[i]) return {};
    const SolvePlan& plan = scene_.plan;
    const char* const followed = plan.mechanisms[i].follows;
    const Prospect prospect = followed ? Prospect() : mechanisms_[i]->prospect(look);
    const Decision decision = followed ? Decision{before[plan.index_of(followed)].ran}
                                       : decide(prospect, look.tubes, scene_.band.frequencies.size(), plan.tubes.tolerance_db);
    Contribution result;
    if (decision.any()) {
      result = mechanisms_[i]->solve(look, decision.wanted, sink);
      assert(result.s.size() <= plan.mechanisms[i].columns.size());
      if (result.ran.empty()) result.ran = decision.wanted;
      if (sink.image) sink.image->mechanisms.resize(sink.image->pieces.size(), i);
    }
    result.most_db = decision.most_db;
    if (prospect.reach < least_reach) result.reach = prospect.reach;
    return result;
  }

  // Rays in the place of currents; a path counts as a tube.
  LookResult rays(const Look& look, Progress& progress, double share) const {
    RayLookResult found = ray_fields_->look(look, scene_.band.frequencies);
    LookResult result;
    result.tubes.bounces = std::move(found.bounces);
    result.tubes.error.resize(scene_.band.frequencies.size());
    result.tubes.tubes = std::accumulate(found.paths.begin(), found.paths.end(), found.edge_rays);
    result.tubes.hits = std::move(found.paths);
    result.tubes.rays = found.rays;
    result.tubes.truncated[Truncation::number].tubes = found.cut ? 1 : 0;
    result.mechanisms.resize(scene_.plan.mechanisms.size());
    Contribution& edges =
        result.mechanisms[scene_.plan.index_of("edges")];  // diffracted rays stand in the place of edge currents
    edges.s = {std::move(found.edges)};
    edges.counts = {{.what = "wedges_lit", .count = found.edge_rays, .fold = Fold::most}};
    result.met.resize(1), result.truncated.resize(1);
    progress.add(share);
    return result;
  }

  BandScene scene_;
  std::size_t band_;
  const ModelUncertainty& model_;
  std::vector<std::unique_ptr<Mechanism>> mechanisms_;  // in the order of the plan; null: not there
  std::optional<RayFields> ray_fields_;
};

LookSolver::LookSolver(const SolvePlan& plan) : plan_(plan), model_(plan) {
  for (std::size_t b = 0; b < plan.bands.size(); ++b) bands_.push_back(std::make_unique<const BandSolver>(plan, b, model_));
}

LookSolver::~LookSolver() = default;

LookResult LookSolver::solve(std::size_t index, Progress& progress, double share) const {
  const Look& look = plan_.sweep.looks[index];
  if (bands_.size() == 1) return bands_.front()->solve(look, progress, share);
  LookResult all;
  const double each = share / static_cast<double>(bands_.size());
  for (std::size_t b = 0; b < bands_.size(); ++b)
    put_band(plan_.bands[b], bands_[b]->solve(look, progress, each), plan_.sweep.frequencies.size(), all);
  return all;
}

void LookSolver::solve_image(std::size_t index, std::size_t frequency_index, const ImageLattice& lattice, Progress& progress,
                             LookImage& image) const {
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const std::vector<std::size_t>& indices = plan_.bands[b].indices;
    const auto found = std::ranges::find(indices, frequency_index);
    if (found != indices.end())
      bands_[b]->solve_image(plan_.sweep.looks[index], static_cast<std::size_t>(found - indices.begin()), lattice, progress,
                             image);
  }
}

void LookSolver::solve_pieces(std::size_t index, const ImageLattice& currents, const ImageLattice& edges, Progress& progress,
                              const PieceSink& sink, const std::optional<double>& mirror) const {
  bands_.front()->solve_pieces(plan_.sweep.looks[index], currents, edges, progress, sink, mirror);
}

std::vector<SurfaceRay> LookSolver::surface_rays(const Look& look) const {
  std::vector<SurfaceRay> rays;
  for (const auto& band : bands_) std::ranges::move(band->surface_rays(look), std::back_inserter(rays));
  for (SurfaceRay& ray : rays)
    for (SurfaceRayPoint& point : ray.points) point.position += plan_.target.mesh.center;
  return rays;
}

std::vector<double> LookSolver::edge_lengths() const {
  std::vector<double> lengths(plan_.sweep.frequencies.size());
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const std::vector<double> part = bands_[b]->edge_lengths();
    for (std::size_t i = 0; i < part.size(); ++i) lengths[plan_.bands[b].indices[i]] = part[i];
  }
  return lengths;
}

}  // namespace raytube
