#include "solve/solve.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "mesh/features/enclosed.h"
#include "mesh/features/symmetry.h"
#include "sbr/launch/launch.h"
#include "solve/look_result.h"
#include "solve/parts.h"
#include "solve/rows.h"
#include "utd/fringe/material_edges.h"
#include "utd/gtd/ray_fields.h"

namespace raytube {

namespace {

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
                                progress, share, sweep.radar, sweep.materials);
  if (edges_count(edges, options)) result.edges = edges.scattering(look, sweep.radar);
  if (options.edges.method == EdgeMethod::fringe && options.edges.materials == MaterialEdgeMethod::luebbers)
    add_material_edges(result.edges, {target.wedges, target.outlines, target.tracer}, sweep.materials, look, sweep.frequencies,
                       options.edges.receiver_shadow);
  result.interaction = edges.interaction(look, interaction_tolerance(result.tubes, options));
  for (std::size_t f = 0; !look.far() && f < result.interaction.scattering.size(); ++f)
    result.interaction.scattering[f] *= from_plane_waves(target.mesh, look, sweep.radar, sweep.frequencies[f]);
  if (sweep.bistatic) return result;
  for (std::vector<ScatteringMatrix>& bounce : result.tubes.bounces) make_reciprocal(bounce);
  for (ChannelErrors& error : result.tubes.error) error[0][1] = error[1][0] = 0.5 * (error[0][1] + error[1][0]);
  make_reciprocal(result.edges.scattering);
  make_reciprocal(result.edges.higher);
  make_reciprocal(result.interaction.scattering);
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
  result.tubes.tubes_truncated = found.cut ? 1 : 0;
  result.edges.wedges_lit = found.edge_rays;
  result.edges.scattering = std::move(found.edges);
  progress.add(share);
  return result;
}

// One kept from an earlier run, if there is.
std::optional<LookResult> kept_look(const KeptLooks& kept, std::size_t place, const Sweep& sweep) {
  if (!kept.find) return {};
  const std::string bytes = kept.find(place);
  return bytes.empty() ? std::nullopt : look_of_bytes(bytes, sweep.frequencies.size());
}

}  // namespace

Target::Target(TriangleMesh triangles, const WedgeOptions& how)
    : owned_(std::make_unique<const TriangleMesh>(std::move(triangles))),
      mesh(*owned_),
      options(how),
      tracer(mesh),
      faces(mesh),
      convexity(find_convexity(mesh)),
      wedges(find_wedges(mesh, how.min_wedge_angle)),
      wedges_enclosed(mark_enclosed(mesh, find_enclosed_components(faces), wedges)),
      outlines(mesh, wedges, how.min_wedge_angle),
      rims(how.thin_plates ? find_thin_plate_edges(mesh, wedges) : std::vector<ThinPlateEdge>()) {}

std::vector<Skipped> skipped_wedges(std::span<const Wedge> wedges, std::span<const ThinPlateEdge> rims, const EdgeOptions& edges,
                                    std::span<const double> frequencies) {
  if (edges.method == EdgeMethod::none) return {{"wedges", "edges.method is \"none\"", wedges.size()}};
  const auto concave = std::ranges::count_if(wedges, [](const Wedge& wedge) { return !wedge.convex(); });
  const Skipped reflecting{"wedges", "concave: multiple reflection stands for them", static_cast<std::uint64_t>(concave)};
  if (edges.method == EdgeMethod::utd) return {reflecting};
  const auto other = edges.materials == MaterialEdgeMethod::none
                         ? std::ranges::count_if(wedges, [](const Wedge& w) { return w.convex() && !w.conducting(); })
                         : 0;
  const std::vector<Wedge> merged = merge_thin_plate_edges(wedges, rims, thin_limit(std::ranges::min(frequencies)));
  return {reflecting,
          {"wedges", "a face is no perfect conductor (edges.materials)", static_cast<std::uint64_t>(other)},
          {"wedges", "across the rim of a thin sheet, no longer than it is thick", thin_plate_corners(merged)}};
}

namespace {

bool wants_interaction(const Target& target, const EdgeOptions& edges) {
  return edges.interaction && edges.method == EdgeMethod::fringe && !target.convexity.no_reflection;
}

}  // namespace

std::uint64_t looks_too_near_for_interaction(const Target& target, const Sweep& sweep, const EdgeOptions& edges) {
  return wants_interaction(target, edges) && !waves_are_plane(target.mesh, sweep) ? sweep.looks.size() : 0;
}

std::uint64_t looks_without_interaction_for_materials(const Target& target, const Sweep& sweep, const EdgeOptions& edges) {
  return wants_interaction(target, edges) && !sweep.materials.empty() ? sweep.looks.size() : 0;
}

std::vector<bool> above_interaction_limit(const Target& target, const Sweep& sweep, const EdgeOptions& edges) {
  if (!wants_interaction(target, edges) || !sweep.materials.empty() || !waves_are_plane(target.mesh, sweep)) return {};
  return interaction_limit_exceeded(target.mesh, target.wedges, sweep.frequencies);
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

double densest_tubes(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes) {
  const double shortest = wavelength(std::ranges::max(sweep.frequencies));
  double most = std::numeric_limits<double>::infinity();
  for (const Look& look : sweep.looks) most = std::min(most, densest_grid(mesh, look, shortest, tubes.up));
  return most;
}

void check_density(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes, EdgeMethod method) {
  if (method == EdgeMethod::utd) return;
  // No look sees more of the target than its sphere; an antenna in front of it (stands_in_front) sees it up to 20 times as large.
  const double widest = (all_far(sweep) ? 2.0 : 40.0) * mesh.radius / wavelength(std::ranges::max(sweep.frequencies));
  const double density = first_density(tubes);
  if (widest * density < 1e6) return;
  if (const double most = densest_tubes(mesh, sweep, tubes); density > most) throw InputError(too_dense(density, most));
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
  check_materials(target.mesh, sweep);
  check_antennas(target.mesh, sweep);
  check_density(target.mesh, sweep, options.tubes, options.edges.method);
  const auto start = std::chrono::steady_clock::now();
  Progress progress(options.progress);

  const EdgeSets edges(edge_setup(target, sweep, options));
  const double range = ray_range(target, sweep, options.edges);
  std::optional<RayFields> rays;
  if (range > 0.0)
    rays.emplace(target.tracer, target.wedges, range, target.convexity.no_reflection ? 1 : options.tubes.max_bounces);
  const std::optional<SmoothSurfaces> smooth =
      rays ? std::optional<SmoothSurfaces>() : smooth_surfaces(target, sweep, options.tubes);
  // Looks run side by side, tiles within a look too; every sum is taken in index order, so threads never show in the result.
  const LookPlan plan =
      rays ? plan_of(target, sweep, options.tubes, EdgeMethod::utd) : plan_of(target, sweep, options.tubes, smooth.has_value());
  if (options.kept.begin) options.kept.begin(plan.computed.size());
  RowCollector rows(target, sweep, options, plan);
  const double share = 1.0 / static_cast<double>(plan.computed.size());
  const auto solve_place = [&](std::size_t place) {
    if (const std::optional<LookResult> known = kept_look(options.kept, place, sweep)) {
      rows.add(place, *known);
      return progress.add(share);
    }
    const Look& look = sweep.looks[plan.computed[place]];
    LookResult found = rays ? solve_look(*rays, sweep, look, progress, share)
                            : solve_look(target, smooth ? &*smooth : nullptr, edges, sweep, look, options, progress, share);
    stop_if_cancelled();
    found.keep_sums_only();
    rows.add(place, found);
    if (options.kept.keep) options.kept.keep(place, look_bytes(found));
  };
  run_on_threads(options.threads, [&] {
    // A thread that waits for the tiles of its look begins no other look: so many looks are under way as there are threads.
    tbb::parallel_for(std::size_t{0}, plan.computed.size(),
                      [&](std::size_t place) { tbb::this_task_arena::isolate([&] { solve_place(place); }); });
  });
  SweepResult result = rows.finish(above_interaction_limit(target, sweep, options.edges));
  result.statistics.ray_range = range;
  result.statistics.solve_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace raytube
