#include "solve.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "mesh/enclosed.h"
#include "mesh/mirror.h"
#include "sbr/launch.h"
#include "skipped.h"
#include "solve_parts.h"
#include "utd/ray_fields.h"

namespace raytube {

namespace {

// One look, all frequencies: what the tubes and the wedges give, kept apart.
struct LookResult {
  TubeSums tubes;
  EdgeLookResult edges;
  BetweenResult between;
};

// All of the target in front, as seen from the antenna towards the target and towards the origin, for which V and H are given.
void check_place(const TriangleMesh& mesh, const Antenna& antenna) {
  const bool past_origin = std::ranges::any_of(
      mesh.vertices, [&](const dvec3& vertex) { return glm::dot(vertex - antenna.position(), antenna.radial()) >= 0.0; });
  if (past_origin || !stands_in_front(mesh, antenna.position()))
    throw InputError(fmt::format(
        "an antenna {:.6g} m from the mesh's origin stands beside the target, or too near to it, to have all of it and "
        "the origin in front, within 45 degrees of the line to its middle; move it away (radar.range_m, radar.position_m), or "
        "check target.unit",
        antenna.range()));
  if (!(glm::dot(antenna.axis(), antenna.radial()) < 0.0))
    throw InputError("radar.aim_m lies at an antenna, or behind one; give a point on the side of the target");
}

// A measured pattern says nothing beyond its ends.
void check_pattern(const TriangleMesh& mesh, const Antenna& antenna, const AntennaPattern& pattern) {
  if (pattern.azimuth.angles.empty() && pattern.elevation.angles.empty()) return;
  for (const dvec3& vertex : mesh.vertices) {
    const dvec2 angles = antenna.off_axis(antenna.ray_to(vertex).direction);
    if (!pattern.azimuth.reaches(angles.x) || !pattern.elevation.reaches(angles.y))
      throw InputError(
          fmt::format("the target reaches {:.3g} degrees off the antenna's axis in azimuth and {:.3g} in elevation, beyond "
                      "the pattern in radar.pattern_csv; add rows up to there",
                      angles.x / degree, angles.y / degree));
  }
}

// A radar on a circle about the origin is in the same place again where its directions repeat.
LookPlan plan_near(const Sweep& sweep) {
  const bool circle = std::ranges::all_of(sweep.looks, [&](const Look& look) {
    return look.transmit_range == sweep.looks[0].transmit_range && look.receive_range == sweep.looks[0].receive_range;
  });
  return circle ? plan_looks(sweep.looks, {false, false, false}) : plan_all(sweep.looks.size());
}

LookPlan plan_of(const Target& target, const Sweep& sweep, const TubeOptions& tubes, bool curved) {
  if (!tubes.skip) return plan_all(sweep.looks.size());
  if (!all_far(sweep)) return plan_near(sweep);
  const bool exact = tubes.mode == TubeMode::adaptive && tubes.clip && (!curved || target.convexity.no_reflection);
  if (!exact) return plan_looks(sweep.looks, {false, false, false});
  const LookPlan at_best = plan_looks(sweep.looks, {true, true, true});
  if (at_best.mirrored == 0) return at_best;
  return plan_looks(sweep.looks, find_mirror_planes(target.mesh, target.wedges, curved));
}

LookResult solve_look(const Target& target, const SmoothSurfaces* smooth, const EdgeSets& edges, const Sweep& sweep,
                      const Look& look, const SolveOptions& options, Progress& progress, double share) {
  LookResult result;
  result.tubes = sbr_scattering(target.tracer, target.faces, smooth, target.convexity, look, sweep.frequencies, options.tubes,
                                progress, share, sweep.radar);
  if (edges_count(edges, options))
    result.edges = edges.scattering(target.tracer, look, options.edges.order, options.edges.receiver_shadow,
                                    options.edges.transition, sweep.radar);
  result.between = edges.between(target.faces, target.tracer, look, between_options(result.tubes, options));
  for (std::size_t f = 0; !look.far() && f < result.between.scattering.size(); ++f)
    result.between.scattering[f] *= from_plane_waves(target.mesh, look, sweep.radar, sweep.frequencies[f]);
  if (sweep.bistatic) return result;
  for (std::vector<ScatteringMatrix>& bounce : result.tubes.bounces) make_reciprocal(bounce);
  for (ChannelErrors& error : result.tubes.error) error[0][1] = error[1][0] = 0.5 * (error[0][1] + error[1][0]);
  make_reciprocal(result.edges.scattering);
  make_reciprocal(result.edges.higher);
  make_reciprocal(result.between.scattering);
  return result;
}

// The same with rays in the place of currents; a path counts as a tube.
LookResult solve_look(const RayFields& rays, const Sweep& sweep, const Look& look, Progress& progress, double share) {
  RayLookResult found = rays.look(look, sweep.frequencies);
  LookResult result;
  result.tubes.bounces = std::move(found.bounces);
  result.tubes.error.resize(sweep.frequencies.size());
  result.tubes.tubes = std::accumulate(found.paths.begin(), found.paths.end(), found.edge_rays);
  result.tubes.hits = std::move(found.paths);
  result.tubes.rays = found.rays;
  result.tubes.tubes_cut = found.cut ? 1 : 0;
  result.edges.wedges_lit = found.edge_rays;
  result.edges.scattering = std::move(found.edges);
  progress.add(share);
  return result;
}

ScatteringMatrix scaled(ScatteringMatrix matrix, Complex factor) { return matrix *= factor; }

// Puts the looks' results in their rows, in look order, and adds up the counts.
class Collector {
 public:
  Collector(const Sweep& sweep, const Target& target, const SolveOptions& options)
      : sweep_(sweep), target_(target), options_(options) {
    result_.total.resize(sweep.rows());
    result_.error.resize(sweep.rows());
    if (!options.keep_parts) return;
    result_.edges_first.resize(sweep.rows());
    result_.edges_higher.resize(sweep.rows());
    result_.between.resize(sweep.rows());
  }

  // What was traced for a look.
  void count(const LookResult& part) {
    Statistics& all = result_.statistics;
    all.tubes += part.tubes.tubes;
    all.rays += part.tubes.rays;
    all.lost_rays += part.tubes.lost_rays;
    all.tubes_cut += part.tubes.tubes_cut;
    all.sliver_area += part.tubes.sliver_area;
    if (all.hits.size() < part.tubes.hits.size()) all.hits.resize(part.tubes.hits.size());
    for (std::size_t b = 0; b < part.tubes.hits.size(); ++b) all.hits[b] += part.tubes.hits[b];
    skipped_.empty_cells += part.tubes.empty_cells;
    skipped_.faces_away += part.tubes.faces_away;
  }

  // The rows of a look.
  void add(std::size_t look, const LookResult& part, const LookSource& source) {
    for (std::size_t f = 0; f < sweep_.frequencies.size(); ++f) add_row(look, f, part, source);
    Statistics& all = result_.statistics;
    all.wedges_lit += part.edges.wedges_lit;
    all.painted_pieces += part.between.lit_pieces;
    for (const bool windowed : part.edges.windowed) all.windowed_rows += windowed ? 1 : 0;
    if (part.tubes.tubes == 0 && options_.edges.method != EdgeMethod::utd) ++looks_without_tubes_;
    if (options_.edges.method == EdgeMethod::fringe && !part.edges.lit)
      ++(part.edges.scattering.empty() ? skipped_.edgeless_looks : skipped_.unlit_looks);
  }

  SweepResult finish(const LookPlan& plan, const std::vector<bool>& crowded) {
    Statistics& all = result_.statistics;
    if (looks_without_tubes_)
      all.skipped.push_back({"tubes of a look", "the target has no projected area", looks_without_tubes_});
    for (const Skipped& left_out : skipped_wedges(target_.wedges, target_.rims, options_.edges.method, sweep_.frequencies))
      if (left_out.count) all.skipped.push_back(left_out);
    skipped_.repeated_looks = plan.repeated;
    skipped_.mirrored_looks = plan.mirrored;
    skipped_.crowded_frequencies = static_cast<std::uint64_t>(std::ranges::count(crowded, true));
    skipped_.near_looks = looks_too_near_for_between(target_, sweep_, options_.edges);
    if (options_.tubes.skip) count_spared_by_shape();
    for (const Skipped& item : skipped_items(skipped_)) all.skipped.push_back(item);
    all.wedges = target_.wedges.size();
    if (options_.edges.method == EdgeMethod::fringe) count_thin_rims(target_.rims);
    return std::move(result_);
  }

 private:
  void count_spared_by_shape() {
    const std::vector<std::uint64_t>& hits = result_.statistics.hits;
    if (target_.convexity.no_reflection && !hits.empty()) skipped_.reflected_tubes = hits[0];
    if (options_.edges.method != EdgeMethod::none) skipped_.enclosed_wedges = target_.wedges_enclosed;
  }

  void count_thin_rims(std::span<const Rim> rims) {
    const auto [lowest, highest] = std::ranges::minmax(sweep_.frequencies);
    result_.statistics.thin_rims_lowest = thin_rims(rims, lowest);
    result_.statistics.thin_rims_highest = thin_rims(rims, highest);
  }

  void add_row(std::size_t look, std::size_t f, const LookResult& part, const LookSource& source) {
    const std::size_t row = sweep_.row(look, f);
    const Complex factor = to_mesh_origin(target_.mesh, sweep_.looks[look], sweep_.frequencies[f]);
    result_.error[row] = part.tubes.error[f];
    for (std::size_t b = 0; b < part.tubes.bounces.size(); ++b) {
      const ScatteringMatrix bounce = scaled(from_source(part.tubes.bounces[b][f], source), factor);
      result_.total[row] += bounce;
      if (!options_.keep_parts) continue;
      if (result_.bounces.size() <= b) result_.bounces.emplace_back(sweep_.rows());
      result_.bounces[b][row] = bounce;
    }
    add_between(row, f, part, source, factor);
    if (part.edges.scattering.empty()) return;
    add_edges(row, scaled(from_source(part.edges.scattering[f], source), factor), result_.edges_first);
    if (part.edges.higher.empty()) return;
    add_edges(row, scaled(from_source(part.edges.higher[f], source), factor), result_.edges_higher);
  }

  void add_between(std::size_t row, std::size_t f, const LookResult& part, const LookSource& source, Complex factor) {
    if (part.between.scattering.empty()) return;
    add_edges(row, scaled(from_source(part.between.scattering[f], source), factor), result_.between);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) result_.error[row][p][q] += part.between.error[f][p][q];
  }

  void add_edges(std::size_t row, const ScatteringMatrix& edges, std::vector<ScatteringMatrix>& part) {
    result_.total[row] += edges;
    if (options_.keep_parts) part[row] = edges;
  }

  const Sweep& sweep_;
  const Target& target_;
  const SolveOptions& options_;
  std::uint64_t looks_without_tubes_ = 0;
  SkipCounts skipped_;
  SweepResult result_;
};

}  // namespace

Target::Target(const TriangleMesh& triangles, const EdgeOptions& edges)
    : mesh(triangles),
      tracer(triangles),
      faces(triangles),
      convexity(find_convexity(triangles)),
      wedges(find_wedges(triangles, edges.min_wedge_angle)),
      wedges_enclosed(mark_enclosed(triangles, find_enclosed_components(faces), wedges)),
      outlines(triangles, wedges, edges.min_wedge_angle),
      rims(edges.thin_sheets ? find_rims(triangles, wedges) : std::vector<Rim>()),
      min_wedge_angle(edges.min_wedge_angle) {}

std::vector<Skipped> skipped_wedges(std::span<const Wedge> wedges, std::span<const Rim> rims, EdgeMethod method,
                                    std::span<const double> frequencies) {
  if (method == EdgeMethod::none) return {{"wedges", "edges.method is \"none\"", wedges.size()}};
  const auto concave = std::ranges::count_if(wedges, [](const Wedge& wedge) { return !wedge.convex(); });
  if (method == EdgeMethod::utd)
    return {{"wedges", "concave: multiple reflection stands for them", static_cast<std::uint64_t>(concave)}};
  const std::vector<Wedge> merged = merge_thin_rims(wedges, rims, thin_limit(std::ranges::min(frequencies)));
  return {{"wedges", "concave: multiple reflection stands for them", static_cast<std::uint64_t>(concave)},
          {"wedges", "across the rim of a thin sheet, no longer than it is thick", rim_corners(merged)}};
}

std::uint64_t looks_too_near_for_between(const Target& target, const Sweep& sweep, const EdgeOptions& edges) {
  const bool wanted = edges.between && edges.method == EdgeMethod::fringe && !target.convexity.no_reflection;
  return wanted && !waves_are_plane(target.mesh, sweep) ? sweep.looks.size() : 0;
}

std::vector<bool> crowded_between(const Target& target, const Sweep& sweep, const EdgeOptions& edges) {
  if (!edges.between || edges.method != EdgeMethod::fringe || target.convexity.no_reflection) return {};
  if (!waves_are_plane(target.mesh, sweep)) return {};
  return between_crowded(target.mesh, target.wedges, sweep.frequencies);
}

void check_antennas(const TriangleMesh& mesh, const Sweep& sweep) {
  for (const Look& look : sweep.looks) {
    if (look.far()) continue;
    const AntennaPair antennas(look, sweep.radar, mesh.center);
    for (const Antenna* antenna : {&antennas.transmit, &antennas.receive}) {
      check_place(mesh, *antenna);
      check_pattern(mesh, *antenna, sweep.radar.pattern);
    }
  }
}

LookPlan plan_of(const Target& target, const Sweep& sweep, const TubeOptions& tubes, EdgeMethod method) {
  if (method == EdgeMethod::utd)
    return tubes.skip ? plan_looks(sweep.looks, {false, false, false}) : plan_all(sweep.looks.size());
  return plan_of(target, sweep, tubes, smooth_surfaces(target, sweep, tubes).has_value());
}

double ray_range(const Target& target, const Sweep& sweep, const EdgeOptions& edges) {
  if (edges.method != EdgeMethod::utd) return 0.0;
  const double range =
      edges.utd_range > 0.0 ? edges.utd_range : default_ray_range(target.mesh, std::ranges::max(sweep.frequencies));
  check_ray_range(target.mesh, range);
  return range;
}

SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options) {
  check(sweep, options);
  check_antennas(target.mesh, sweep);
  const auto start = std::chrono::steady_clock::now();
  Progress progress(options.progress);

  EdgeSets edges(target.mesh, target.wedges, target.outlines, target.rims, target.min_wedge_angle, sweep.frequencies,
                 options.tubes.skip);
  prepare_between(edges, target, sweep, options.edges);
  const double range = ray_range(target, sweep, options.edges);
  std::optional<RayFields> rays;
  if (range > 0.0)
    rays.emplace(target.tracer, target.wedges, range, target.convexity.no_reflection ? 1 : options.tubes.max_bounces);
  const std::optional<SmoothSurfaces> smooth =
      rays ? std::optional<SmoothSurfaces>() : smooth_surfaces(target, sweep, options.tubes);
  // Looks run side by side, tiles within a look too; every sum is taken in index order, so threads never show in the result.
  const LookPlan plan =
      rays ? plan_of(target, sweep, options.tubes, EdgeMethod::utd) : plan_of(target, sweep, options.tubes, smooth.has_value());
  std::vector<LookResult> computed(plan.computed.size());
  const double share = 1.0 / static_cast<double>(computed.size());
  run_on_threads(options.threads, [&] {
    tbb::parallel_for(std::size_t{0}, computed.size(), [&](std::size_t i) {
      const Look& look = sweep.looks[plan.computed[i]];
      computed[i] = rays ? solve_look(*rays, sweep, look, progress, share)
                         : solve_look(target, smooth ? &*smooth : nullptr, edges, sweep, look, options, progress, share);
    });
  });
  Collector collector(sweep, target, options);
  for (const LookResult& look : computed) collector.count(look);
  for (std::size_t i = 0; i < sweep.looks.size(); ++i) {
    const LookSource& source = plan.sources[i];
    collector.add(i, computed[source.place], source);
  }
  SweepResult result = collector.finish(plan, crowded_between(target, sweep, options.edges));
  result.statistics.ray_range = range;
  result.statistics.solve_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace raytube
