#include "solve/plan.h"

#include <algorithm>
#include <chrono>
#include <ranges>

#include "mesh/features/resolved_wedges.h"
#include "mesh/features/symmetry.h"
#include "solve/admissible.h"
#include "utd/gtd/ray_fields.h"
#include "utd/interaction/interaction_groups.h"

namespace raytube {

namespace {

// Tubes see facets where waves run over the surface behind them: rises of more than this many wavelengths put both out of phase.
constexpr double most_rise = 1.0 / 32.0;

// How deep a facet may seem to lie below its neighbours on a convex surface, in rises of that over its facets: normals at
// vertices are means of few facets, wrong by up to what the surface turns over one of them.
constexpr double most_dent = 4.0;

// k a^2 / R [rad], both ways together the phase by which a spherical wave is late where a target reaches a from the origin.
constexpr double most_phase = 0.5;

Mechanisms mechanisms_of(const SolvePlan& plan) {
  const bool fringe = plan.edges.method == EdgeMethod::fringe;
  const bool plane_conductors = plan.sweep.materials.empty() && waves_are_plane(plan.target.mesh, plan.sweep);
  return {.rays = plan.edges.method == EdgeMethod::utd,
          .fringe = fringe,
          .material_edges = fringe && plan.edges.materials == MaterialEdgeMethod::luebbers,
          .screens = fringe && std::ranges::any_of(plan.sweep.materials, &Material::transmits),
          .interaction = fringe && plan.edges.interaction.possible() && plan.edges.interaction_budget > 0.0 &&
                         !plan.convexity.no_reflection && plane_conductors};
}

double ray_range_of(const SolvePlan& plan) {
  if (!plan.mechanisms.rays) return 0.0;
  const double highest = std::ranges::max(plan.sweep.frequencies);
  const double range = plan.edges.utd_range > 0.0 ? plan.edges.utd_range : default_ray_range(plan.target.mesh, highest);
  check_ray_range(plan.target.mesh, range);
  return range;
}

// Facets are taken as the surfaces they stand for where a body is convex, or always if asked.
bool bends_facets(const SolvePlan& plan) {
  return plan.edges.method != EdgeMethod::utd && plan.tubes.refines() && plan.tubes.curved != CurvedSurfaces::never;
}

// A body all of whose hollows are those between the facets of its surfaces reflects nothing onto itself. Hollow edges are none of
// those: beside them only dents that are small in wavelengths are passed over.
Convexity convexity_of(const SolvePlan& plan, const SmoothSurfaces& surfaces) {
  Convexity convexity = plan.target.convexity;
  const TriangleMesh& mesh = plan.target.mesh;
  if (convexity.no_reflection || !plan.tubes.skip || surfaces.facets() <= mesh.triangles.size() / 2) return convexity;
  const double small = most_rise * plan.shortest_wavelength();
  const bool tessellation = std::ranges::all_of(plan.target.wedges, &Wedge::convex);
  convexity.no_reflection = convex_up_to(mesh, tessellation ? std::max(small, most_dent * surfaces.rise()) : small);
  return convexity;
}

// Only convex bodies bend their facets by default, and a mesh of several components is none.
bool may_be_convex(const SolvePlan& plan) {
  const std::vector<Component>& components = plan.target.mesh.components;
  return plan.convexity.no_reflection || (plan.tubes.skip && components.size() == 1 && components[0].closed);
}

void plan_curved_surfaces(SolvePlan& plan) {
  const bool convex_only = plan.tubes.curved == CurvedSurfaces::convex || !all_far(plan.sweep);
  if (!bends_facets(plan) || (convex_only && !may_be_convex(plan))) return;
  auto surfaces = std::make_shared<const SmoothSurfaces>(plan.target.mesh, plan.target.options.min_wedge_angle);
  if (!surfaces->any()) return;
  plan.convexity = convexity_of(plan, *surfaces);
  if (!convex_only || plan.convexity.no_reflection) plan.smooth = std::move(surfaces);
}

// Waves run over the curved surfaces of any body, even of one whose tubes meet its facets, unless the facets are what is meant.
SurfaceWaveState surface_waves_asked(const SolvePlan& plan) {
  if (!plan.surfaces.waves.possible()) return SurfaceWaveState::not_asked;
  if (!plan.mechanisms.fringe) return SurfaceWaveState::no_edge_currents;
  const bool facets_meant = !plan.tubes.refines() || plan.tubes.curved == CurvedSurfaces::never;
  return facets_meant ? SurfaceWaveState::facets_meant : SurfaceWaveState::computed;
}

void plan_surface_waves(SolvePlan& plan) {
  plan.surface_waves = surface_waves_asked(plan);
  if (plan.surface_waves != SurfaceWaveState::computed) return;
  const double wavelength = plan.shortest_wavelength();
  std::shared_ptr<const SmoothSurfaces> bent = plan.smooth;
  if (!bent)
    bent = std::make_shared<const SmoothSurfaces>(plan.target.mesh, plan.target.options.min_wedge_angle, most_rise * wavelength);
  if (bent->any()) plan.wave_surfaces = bent;
  if (!plan.wave_surfaces)
    plan.surface_waves = SurfaceWaveState::no_curved_surface;
  else if (bent->conducting_facets() == 0)
    plan.surface_waves = SurfaceWaveState::no_conductor;
  else if (!all_far(plan.sweep))
    plan.surface_waves = SurfaceWaveState::near_antennas;
  else if (bent->boundary_length() > longest_surface_edges * wavelength)
    plan.surface_waves = SurfaceWaveState::long_edges;
  plan.mechanisms.surface_waves = plan.surface_waves == SurfaceWaveState::computed;
}

// A radar on a circle about the origin is at the same point again where its directions repeat.
LookPlan near_looks(const Sweep& sweep) {
  const bool circle = std::ranges::all_of(sweep.looks, [&](const Look& look) {
    return look.transmit_range == sweep.looks[0].transmit_range && look.receive_range == sweep.looks[0].receive_range;
  });
  return circle ? plan_looks(sweep.looks, {false, false, false}) : plan_all(sweep.looks.size());
}

// Images of looks follow where tubes are cut exactly: the grid of uniform tubes, and of those that curved surfaces reflect, is
// not its own image; nor are rays that are searched for, or radars at a finite distance from the origin.
LookPlan looks_of(const SolvePlan& plan) {
  const Sweep& sweep = plan.sweep;
  if (!plan.tubes.skip) return plan_all(sweep.looks.size());
  if (!all_far(sweep)) return near_looks(sweep);
  const bool exact = plan.tubes.refines() && (!plan.smooth || plan.convexity.no_reflection);
  if (!exact || plan.mechanisms.rays) return plan_looks(sweep.looks, {false, false, false});
  const LookPlan at_best = plan_looks(sweep.looks, {true, true, true});
  if (at_best.mirrored == 0) return at_best;
  return plan_looks(sweep.looks, find_symmetry_planes(plan.target.mesh, plan.target.wedges, plan.smooth != nullptr));
}

// What takes no part in edge-face interaction for its size.
void count_too_small(const SolvePlan& plan, SkipCounts& counts) {
  const std::vector<double>& frequencies = plan.sweep.frequencies;
  const TooSmall small = too_small_to_interact(plan.target.mesh, plan.target.wedges, std::ranges::min(frequencies));
  counts.short_edges = small.edges;
  counts.small_faces = small.faces;
  counts.frequencies_without_large =
      std::ranges::count_if(frequencies, [&](double frequency) { return wavelength(frequency) > small.longest; });
}

SkipCounts skips_of(const SolvePlan& plan) {
  const bool asked =
      plan.edges.interaction.possible() && plan.edges.method == EdgeMethod::fringe && !plan.convexity.no_reflection;
  const std::uint64_t looks = plan.sweep.looks.size();
  SkipCounts counts{.repeated_looks = plan.looks.repeated, .mirrored_looks = plan.looks.mirrored};
  if (asked && plan.edges.interaction_budget == 0.0) counts.unbudgeted_looks = looks;
  if (plan.mechanisms.interaction) count_too_small(plan, counts);
  if (asked && !waves_are_plane(plan.target.mesh, plan.sweep)) counts.near_looks = looks;
  if (asked && !plan.sweep.materials.empty()) counts.material_looks = looks;
  if (plan.surface_waves == SurfaceWaveState::near_antennas) counts.near_surface_looks = looks;
  if (plan.surface_waves == SurfaceWaveState::long_edges) counts.long_surface_looks = looks;
  if (plan.tubes.skip && plan.edges.method != EdgeMethod::none) counts.enclosed_wedges = plan.target.wedges_enclosed;
  return counts;
}

std::vector<Skipped> skipped_wedges_of(const SolvePlan& plan) {
  const std::vector<Wedge>& wedges = plan.target.wedges;
  if (plan.edges.method == EdgeMethod::none) return {{"wedges", "edges.method is \"none\"", wedges.size()}};
  const auto count = [&](auto left_out) { return static_cast<std::uint64_t>(std::ranges::count_if(wedges, left_out)); };
  std::vector<Skipped> skipped{
      {"wedges", "concave: multiple reflection stands for them", count([](const Wedge& w) { return !w.convex(); })}};
  if (plan.mechanisms.rays) return skipped;
  if (!plan.mechanisms.material_edges)
    skipped.push_back({"wedges", "a face is not a perfect conductor (edges.materials)",
                       count([](const Wedge& w) { return w.convex() && !w.conducting(); })});
  const double lowest = std::ranges::min(plan.sweep.frequencies);
  std::vector<Wedge> merged = merge_thin_plate_edges(wedges, plan.target.thin_plate_edges, thin_limit(lowest));
  skipped.push_back({"wedges", "across the edge of a thin plate, no longer than it is thick", thin_plate_corners(merged)});
  resolve_details(plan.target.mesh, merged, detail_limit(lowest), plan.target.options.min_wedge_angle);
  skipped.push_back({"wedges", "flat to the wave: steps, slivers and ripples finer than wavelength / 100",
                     static_cast<std::uint64_t>(std::ranges::count_if(merged, [](const Wedge& w) { return w.flat; }))});
  return skipped;
}

void check_all(const SolvePlan& plan) {
  check_options(plan.sweep, plan.tubes, plan.edges);
  check_materials(plan.target.mesh, plan.sweep);
  check_antennas(plan.target.mesh, plan.sweep);
  if (plan.edges.method != EdgeMethod::utd) check_density(plan.target.mesh, plan.sweep, plan.tubes);
}

}  // namespace

SolvePlan::SolvePlan(const Target& on, const Sweep& asked, const SolveOptions& options)
    : target(on),
      sweep(asked),
      tubes(options.tubes),
      edges(options.edges),
      surfaces(options.surfaces),
      threads(options.threads),
      keep_parts(options.keep_parts) {
  check_all(*this);
  const auto start = std::chrono::steady_clock::now();
  convexity = target.convexity;
  plan_curved_surfaces(*this);
  mechanisms = mechanisms_of(*this);
  ray_range = ray_range_of(*this);
  plan_surface_waves(*this);
  looks = looks_of(*this);
  skips = skips_of(*this);
  skipped_wedges = skipped_wedges_of(*this);
  std::erase_if(skipped_wedges, [](const Skipped& item) { return item.count == 0; });
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

const char* why_not(SurfaceWaveState state) {
  switch (state) {
    case SurfaceWaveState::computed:
      return "";
    case SurfaceWaveState::not_asked:
      return "surfaces.waves is false";
    case SurfaceWaveState::no_edge_currents:
      return "they are computed together with edge currents (edges.method \"fringe\")";
    case SurfaceWaveState::facets_meant:
      return "tubes.curved \"never\" and tubes that are not clipped take facets as the surface itself";
    case SurfaceWaveState::no_curved_surface:
      return "no curved surface";
    case SurfaceWaveState::no_conductor:
      return "no curved surface is a perfect conductor";
    case SurfaceWaveState::near_antennas:
      return "antennas at a finite distance";
    case SurfaceWaveState::long_edges:
      return "edges of curved surfaces too long in wavelengths";
  }
  return "";
}

double SolvePlan::shortest_wavelength() const { return wavelength(std::ranges::max(sweep.frequencies)); }

bool waves_are_plane(const TriangleMesh& mesh, const Sweep& sweep) {
  const double reach = glm::length(mesh.center) + mesh.radius;
  const double phase = wavenumber(std::ranges::max(sweep.frequencies)) * reach * reach;
  return std::ranges::all_of(sweep.looks, [&](const Look& look) {
    return look.far() || phase < most_phase * std::min(look.transmit_range, look.receive_range);
  });
}

}  // namespace raytube
