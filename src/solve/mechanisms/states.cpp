#include "solve/mechanisms/states.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/admissible.h"
#include "plan/material_edges.h"
#include "utd/fock/face_impedances.h"
#include "utd/interaction/interaction_groups.h"

namespace raytube {

namespace {

// Facets of curved surfaces over which waves run.
std::size_t wave_facets(const SolvePlan& plan, const BandPlan& band) {
  if (!band.wave_surfaces) return 0;
  const TriangleMesh& mesh = plan.target.mesh;
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    count += band.wave_surfaces->region(t) != no_index && carries_waves(plan.sweep.materials, mesh.patch_of(t).material);
  return count;
}

// What takes no part for its size.
std::vector<Skipped> skipped_for_size(const TooSmall& small, std::uint64_t frequencies) {
  return {
      {"frequencies without edge-face interaction", "no edge of a wavelength sees a face of a wavelength squared", frequencies},
      {"edges without edge-face interaction", "shorter than a wavelength at the lowest frequency", small.edges},
      {"faces without edge-face interaction", "smaller than a wavelength squared at the lowest frequency", small.faces}};
}

}  // namespace

MechanismState surface_waves_state(const SolvePlan& plan) {
  if (!plan.surfaces.waves.possible()) return without("surfaces.waves is false");
  if (!plan.fringe()) return without("they need edge currents (edges.method = \"fringe\")");
  if (!plan.tubes.refines() || plan.tubes.curved == CurvedSurfaces::never)
    return without("with tubes.curved = \"never\", or uniform tubes, facets are the surface itself");
  const auto is_curved = [](const BandPlan& band) { return band.wave_surfaces != nullptr; };
  if (std::ranges::none_of(plan.bands, is_curved)) return without("no curved surface");
  const auto count = [&](const BandPlan& band) { return wave_facets(plan, band); };
  const BandPlan& most = *std::ranges::max_element(plan.bands, {}, count);
  const std::size_t facets = count(most), others = most.wave_surfaces ? most.wave_surfaces->facets() - facets : 0;
  if (facets == 0) return without("no curved surface is a conductor, coated or bare, or a half-space");
  return {.on = true,
          .forced = plan.surfaces.waves.forced(),
          .what = fmt::format("over {} facets{}", facets,
                              others == 0 ? "" : fmt::format(", not over {} more of other materials", others)),
          .when = "in looks where they can change a row by accuracy.tolerance_db"};
}

bool has_surface_waves(const SolvePlan& plan, const BandPlan& band) {
  return plan.state("surface_waves").on && wave_facets(plan, band) > 0;
}

bool waves_run_over_all_materials(const SolvePlan& plan) {
  const std::vector<Material>& materials = plan.sweep.materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    if (!carries_waves(materials, m)) return false;
  return true;
}

MechanismState edge_currents_state(const SolvePlan& plan) {
  if (!plan.fringe()) return without(plan.rays() ? "edges.method is \"utd\"" : "edges.method is \"none\"");
  const std::vector<Wedge>& wedges = plan.target.wedges;
  const MaterialEdgeCount count = count_material_edges(wedges, plan.sweep.materials, plan.sweep.frequencies);
  const std::size_t of_materials = count.known;
  const bool computed = of_materials > 0 && plan.edges.materials == MaterialEdgeMethod::fringe;
  if (!computed && std::ranges::none_of(wedges, &Wedge::radiates)) {
    if (of_materials > 0) return misses("edges.materials is \"none\"");
    return without(count.of_solids > 0 ? "edges of solids add nothing"
                                       : "the target has no convex edge whose currents are known");
  }
  return {.on = true,
          .forced = true,
          .what = fmt::format("order {}{}", plan.edges.order, computed ? ", and of other materials" : "")};
}

MechanismState interaction_state(const SolvePlan& plan) {
  if (!plan.edges.interaction.possible()) return without("edges.between is false");
  if (!plan.fringe()) return without(edge_currents_state(plan).why_not);
  if (std::ranges::none_of(plan.target.wedges, &Wedge::radiates))
    return without("the target has no convex edge between perfect conductors");
  if (plan.no_reflection()) return without(nothing_in_front);
  if (plan.edges.interaction_budget == 0.0) return misses("edges.between_budget is 0");
  const std::vector<double>& frequencies = plan.sweep.frequencies;
  const TooSmall small = too_small_to_interact(plan.target.mesh, plan.target.wedges, std::ranges::min(frequencies));
  const auto without_large = static_cast<std::uint64_t>(
      std::ranges::count_if(frequencies, [&](double frequency) { return wavelength(frequency) > small.longest; }));
  std::vector<Skipped> skipped = skipped_for_size(small, without_large);
  std::erase_if(skipped, [](const Skipped& item) { return item.count == 0; });
  if (without_large == frequencies.size()) {
    MechanismState none = without("no edge is as long as a wavelength, or no face as wide");
    none.skipped = std::move(skipped);
    return none;
  }
  return {.on = true,
          .forced = plan.edges.interaction.forced(),
          .what = fmt::format("at most {:g} times the work of tubes and edges", plan.edges.interaction_budget),
          .when = "in looks where edges.between_budget reaches half of what is expected",
          .skipped = std::move(skipped)};
}

bool interacts(const SolvePlan& plan, const BandPlan& band) {
  return !band.convexity.no_reflection && plan.state("interaction").on;
}

}  // namespace raytube
