#include "solve/mechanisms/band_scene.h"

#include <algorithm>

#include "solve/mechanisms/list.h"

namespace raytube {

namespace {

// The plan's sets with those of their frequencies that are the band's, counted in the band.
std::vector<WedgesAndCorners> sets_of(const SolvePlan& plan, const BandPlan& band) {
  std::vector<WedgesAndCorners> sets;
  for (std::size_t s = 0; s < plan.wedge_sets.size(); ++s) {
    const WedgeSet& set = plan.wedge_sets[s];
    WedgeSet part = set;
    part.indices.clear();
    for (std::size_t i = 0; i < band.indices.size(); ++i)
      if (std::ranges::binary_search(set.indices, band.indices[i])) part.indices.push_back(i);
    if (!part.indices.empty()) sets.push_back({std::move(part), plan.corner_waves.empty() ? nullptr : plan.corner_waves[s]});
  }
  return sets;
}

EdgeSetup edge_setup(const BandScene& scene) {
  const SolvePlan& plan = scene.plan;
  EdgeSetup setup{plan.target.tracer, plan.target.faces, sets_of(plan, scene.band), scene.band.frequencies};
  setup.interaction = interacts(plan, scene.band);
  setup.interaction_work = interaction_work(plan);
  setup.least_reach = least_reach_of_interaction(plan);
  if (plan.fringe()) setup.materials = scene.materials;
  setup.material_edges = plan.edges.materials == MaterialEdgeMethod::fringe;
  setup.skip_enclosed = plan.tubes.skip;
  setup.curved = scene.curved ? &*scene.curved : nullptr;
  setup.fringe = {plan.edges.order, plan.edges.receiver_shadow, false};
  return setup;
}

std::optional<CurvedTarget> curved_target(const SolvePlan& plan, const BandPlan& band, std::span<const Material> materials) {
  if (!has_surface_waves(plan, band)) return {};
  return std::optional<CurvedTarget>(std::in_place, plan.target.tracer, *band.wave_surfaces, band.convexity.no_reflection,
                                     materials, band.frequencies, plan.surfaces.rounded_edges);
}

}  // namespace

BandScene::BandScene(const SolvePlan& a_plan, const BandPlan& a_band, const CurvedParts& parts)
    : plan(a_plan),
      band(a_band),
      curved_parts(parts),
      materials(at_frequencies(plan.sweep.materials, band.indices)),
      tubes{plan.target.tracer, plan.target.faces, band.smooth.get(), band.convexity, materials, plan.sweep.radar},
      curved(curved_target(plan, band, materials)),
      round_tips(curved && plan.surfaces.round_tips ? find_tips(*curved) : std::vector<Tip>()),
      edges(edge_setup(*this)) {}

}  // namespace raytube
