#include "solve/look_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/work.h"
#include "sbr/beams/tolerances.h"
#include "solve/phase_reference.h"
#include "utd/fringe/material_edges.h"

namespace raytube {

namespace {

constexpr double least_reach = 0.5;  // of the squares expected of edge-face interaction, unless it is forced
constexpr double ray_step = 0.1;     // of the wavelength, between points of rays for pictures

EdgeSetup edge_setup(const SolvePlan& plan, const CurvedTarget* curved) {
  const Target& target = plan.target;
  EdgeSetup setup{
      target.tracer, target.faces, target.wedges, target.outlines, target.thin_plate_edges, target.options.min_wedge_angle};
  setup.frequencies = plan.sweep.frequencies;
  if (plan.mechanisms.interaction) setup.interaction.assign(plan.sweep.frequencies.size(), true);
  if (plan.mechanisms.screens) setup.screens = plan.sweep.materials;
  setup.skip_enclosed = plan.tubes.skip;
  setup.curved = curved;
  setup.fringe = {plan.edges.order, plan.edges.receiver_shadow, plan.edges.transition, false};
  return setup;
}

// Points between the first and the last one are `step` apart at least.
void thin_out(SurfaceRay& ray, double step) {
  std::vector<SurfaceRayPoint> kept{ray.points.front()};
  for (std::size_t i = 1; i < ray.points.size(); ++i)
    if (i + 1 == ray.points.size() || std::abs(ray.points[i].arc_length - kept.back().arc_length) >= step)
      kept.push_back(ray.points[i]);
  ray.points = std::move(kept);
}

// Of all bounces, the mean of both co-polar channels and over frequencies [m^2].
double co_polar_square(const TubeSums& tubes, std::size_t frequencies) {
  double squares = 0.0;
  for (std::size_t f = 0; f < frequencies; ++f) {
    ScatteringMatrix sum;
    for (const std::vector<ScatteringMatrix>& bounce : tubes.bounces) sum += bounce[f];
    squares += 0.5 * (std::norm(sum.vv()) + std::norm(sum.hh()));
  }
  return squares / static_cast<double>(frequencies);
}

void make_reciprocal(LookResult& look) {
  for (std::vector<ScatteringMatrix>& bounce : look.tubes.bounces) make_reciprocal(bounce);
  for (ChannelErrors& error : look.tubes.error) error[0][1] = error[1][0] = 0.5 * (error[0][1] + error[1][0]);
  make_reciprocal(look.edges.scattering);
  make_reciprocal(look.edges.higher);
  make_reciprocal(look.interaction.scattering);
  make_reciprocal(look.surface.scattering);
}

}  // namespace

LookSolver::LookSolver(const SolvePlan& plan)
    : plan_(plan),
      tube_scene_{plan.target.tracer, plan.target.faces,    plan.smooth.get(),
                  plan.convexity,     plan.sweep.materials, plan.sweep.radar},
      curved_(plan.mechanisms.surface_waves ? std::optional<CurvedTarget>(std::in_place, plan.target.tracer, *plan.wave_surfaces,
                                                                          plan.convexity.no_reflection)
                                            : std::nullopt),
      edges_(edge_setup(plan, curved_ ? &*curved_ : nullptr)),
      edges_count_(plan.mechanisms.fringe && (edges_.radiate() || !plan.tubes.skip)) {
  if (curved_ && !plan.surfaces.waves.forced())
    prospect_.emplace(plan.target.mesh, plan.target.wedges, plan.target.options.min_wedge_angle,
                      wavelength(std::ranges::min(plan.sweep.frequencies)));
  if (plan.mechanisms.rays) ray_fields_.emplace(plan.target.tracer, plan.target.wedges, plan.ray_range, plan.max_bounces());
}

LookResult LookSolver::solve(std::size_t index, Progress& progress, double share,
                             const std::function<void(LookStage)>& begins) const {
  const Look& look = plan_.sweep.looks[index];
  if (plan_.mechanisms.rays) return rays(look, progress, share);
  LookResult result;
  result.tubes = sbr_scattering(tube_scene_, look, plan_.sweep.frequencies, plan_.tubes, {progress, first_tubes_share * share});
  if (begins) begins(LookStage::edges);
  if (surface_waves_count(look, result.tubes))
    result.surface = surface_wave_scattering(*curved_, look_vectors(look), plan_.sweep.frequencies);
  result.edges = edges_of(look, result.surface.arrivals);
  if (begins) begins(LookStage::interaction);
  result.interaction = interaction(look, result);
  if (!plan_.sweep.bistatic) make_reciprocal(result);
  progress.add((1.0 - first_tubes_share) * share);
  return result;
}

TubeSums LookSolver::tubes(const Look& look, Progress& progress, CurrentMap& map) const {
  return sbr_scattering(tube_scene_, look, plan_.sweep.frequencies, plan_.tubes, {progress, 1.0, &map});
}

// In the mean over the sweep's band, and a little beside it so that no chance of phases decides, they may change the level by the
// tolerance. Forward of grazing the estimate has lobes of its own: other looks than monostatic ones take them.
bool LookSolver::surface_waves_count(const Look& look, const TubeSums& tubes) const {
  if (!curved_ || !prospect_ || !(look.transmit == look.receive)) return curved_.has_value();
  constexpr int samples = 5;
  constexpr double beside = 0.05;
  const auto [lowest, highest] = std::ranges::minmax(plan_.sweep.frequencies);
  const double from = (1.0 - beside) * lowest, to = (1.0 + beside) * highest;
  double waves = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double amplitude = prospect_->amplitude(look, from + (to - from) * i / (samples - 1));
    waves += amplitude * amplitude / samples;
  }
  const double share = relative_tolerance(plan_.tubes.tolerance_db);
  return waves > share * share * co_polar_square(tubes, plan_.sweep.frequencies.size());
}

std::vector<ImageEdge> LookSolver::surface_pieces(const Look& look, const TubeSums& tubes, std::size_t frequency_index) const {
  if (!surface_waves_count(look, tubes)) return {};
  StripPlaces places{frequency_index};
  const SurfaceWaveResult waves = surface_wave_scattering(*curved_, look_vectors(look), plan_.sweep.frequencies, &places);
  if (edges_count_)
    std::ranges::copy(edges_.arrival_pieces(look, frequency_index, waves.arrivals), std::back_inserter(places.pieces));
  return std::move(places.pieces);
}

std::vector<SurfaceRay> LookSolver::surface_rays(const Look& look) const {
  std::vector<SurfaceRay> rays;
  if (!curved_) return rays;
  const SurfaceWaveResult waves = surface_wave_scattering(*curved_, look_vectors(look), plan_.sweep.frequencies, nullptr, &rays);
  if (edges_count_) std::ranges::copy(edges_.surface_rays(look, waves.arrivals), std::back_inserter(rays));
  for (SurfaceRay& ray : rays) {
    thin_out(ray, ray_step * wavelength(plan_.sweep.frequencies.front()));
    for (SurfaceRayPoint& point : ray.points) point.position += plan_.target.mesh.center;
  }
  return rays;
}

// What a material blocks is 1 - T, at most twice what a conductor does: its edges count as two.
std::vector<double> LookSolver::edge_lengths() const {
  std::vector<double> lengths = edges_.radiating_lengths();
  if (!plan_.mechanisms.material_edges) return lengths;
  double sum = 0.0;
  for (const Wedge& wedge : plan_.target.wedges)
    if (is_material_edge(wedge)) sum += 2.0 * wedge.length();
  for (double& length : lengths) length += sum;
  return lengths;
}

EdgeLookResult LookSolver::edges_of(const Look& look, std::span<const SurfaceArrival> arrivals) const {
  EdgeLookResult result;
  if (edges_count_) result = edges_.scattering(look, plan_.sweep.radar, arrivals);
  if (plan_.mechanisms.material_edges)
    add_material_edges(result, {plan_.target.wedges, plan_.target.outlines, plan_.target.tracer}, plan_.sweep.materials, look,
                       plan_.sweep.frequencies, plan_.edges.receiver_shadow);
  return result;
}

InteractionLimits LookSolver::interaction_limits(const TubeSums& tubes, double edge_work) const {
  const auto frequencies = static_cast<double>(plan_.sweep.frequencies.size());
  const auto met = static_cast<double>(std::accumulate(tubes.hits.begin(), tubes.hits.end(), std::uint64_t{0}));
  const double tube_work = work::tube * static_cast<double>(tubes.tubes) + work::tube_ray * static_cast<double>(tubes.rays) +
                           work::tube_frequency * met * frequencies;
  const double budget = plan_.edges.interaction_budget;
  const bool limited = budget < unlimited_interaction_budget;
  return {interaction_tolerance(tubes), limited ? budget * (tube_work + edge_work) : std::numeric_limits<double>::infinity(),
          plan_.edges.interaction.forced() ? 0.0 : least_reach};
}

InteractionResult LookSolver::interaction(const Look& look, const LookResult& others) const {
  if (!edges_.interact()) return {};
  InteractionResult result = edges_.interaction(look, interaction_limits(others.tubes, others.edges.work));
  for (std::size_t f = 0; !look.far() && f < result.scattering.size(); ++f) {
    const Complex factor = from_plane_waves(plan_.target.mesh, look, plan_.sweep.radar, plan_.sweep.frequencies[f]);
    result.scattering[f] *= factor;
    for (std::array<double, 2>& errors : result.error[f])
      for (double& error : errors) error *= std::abs(factor);
    if (!result.left_out.empty()) result.left_out[f] *= std::abs(factor);
  }
  return result;
}

double LookSolver::interaction_tolerance(const TubeSums& tubes) const {
  double strongest = 0.0;
  for (std::size_t f = 0; !tubes.bounces.empty() && f < tubes.bounces[0].size(); ++f) {
    ScatteringMatrix sum;
    for (const std::vector<ScatteringMatrix>& bounce : tubes.bounces) sum += bounce[f];
    strongest = std::max(strongest, frobenius_norm(sum));
  }
  return interaction_quadrature_error(relative_tolerance(plan_.tubes.tolerance_db), strongest);
}

// Rays in the place of currents; a path counts as a tube.
LookResult LookSolver::rays(const Look& look, Progress& progress, double share) const {
  RayLookResult found = ray_fields_->look(look, plan_.sweep.frequencies);
  LookResult result;
  result.tubes.bounces = std::move(found.bounces);
  result.tubes.error.resize(plan_.sweep.frequencies.size());
  result.tubes.tubes = std::accumulate(found.paths.begin(), found.paths.end(), found.edge_rays);
  result.tubes.hits = std::move(found.paths);
  result.tubes.rays = found.rays;
  result.tubes.truncated[Truncation::number].tubes = found.cut ? 1 : 0;
  result.edges.wedges_lit = found.edge_rays;
  result.edges.scattering = std::move(found.edges);
  progress.add(share);
  return result;
}

}  // namespace raytube
