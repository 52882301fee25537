#include "scene/bounce_names.h"
#include "solve/mechanisms/edge_currents.h"
#include "solve/mechanisms/interaction.h"
#include "solve/mechanisms/states.h"
#include "solve/mechanisms/surface_waves.h"

namespace raytube {

namespace {

// No current on a curved surface is stronger than on a plane, and nothing that an edge diffracts is stronger than what it
// receives.
double surface_bound(const AmplitudeLimits& limits) { return limits.surface; }
double edge_bound(const AmplitudeLimits& limits) { return limits.edges; }
// As much again for every further edge in a row.
double further_edges_bound(const AmplitudeLimits& limits) { return (limits.edge_order - 1) * limits.edges; }

}  // namespace

const std::vector<MechanismEntry>& mechanism_list() {
  static const std::vector<MechanismEntry> list{
      {.name = "surface_waves",
       .label = "waves over curved surfaces",
       .key = "surfaces.waves",
       .budget_key = nullptr,
       .columns = {{"surface_waves", "waves over curved surfaces (surfaces.waves)", surface_bound}},
       .counts = {"surface_strips"},
       .state = surface_waves_state,
       .make = make_surface_waves,
       .bytes = surface_waves_bytes,
       .tell = tell_surface_waves},
      {.name = "edges",
       .label = "edge currents",
       .key = "edges.method",
       .budget_key = nullptr,
       .columns = {{"edges_order_1", "edges, order 1", edge_bound},
                   {"edges_order_2_on", "edges, orders 2 and 3 (edges.order)", further_edges_bound}},
       .counts = {"wedges_lit", "windowed_rows"},
       .state = edge_currents_state,
       .make = make_edge_currents,
       .bytes = edge_currents_bytes,
       .tell = tell_edge_currents},
      {.name = "interaction",
       .label = "edge-face interaction",
       .key = "edges.between",
       .budget_key = "edges.between_budget",
       .columns = {{"interaction", "edge-face interaction (edges.between)", surface_bound}},
       .counts = {"edge_illumination_pieces", "interaction_pairs"},
       .state = interaction_state,
       .make = make_interaction,
       .bytes = interaction_bytes,
       .look_bytes = interaction_look_bytes,
       .budget = [](const SolvePlan& plan) { return plan.edges.interaction_budget; },
       .tell = tell_interaction},
  };
  return list;
}

std::vector<std::string> piece_names() {
  std::vector<std::string> names(tube_pieces.begin(), tube_pieces.end());
  for (const MechanismEntry& mechanism : mechanism_list()) names.emplace_back(mechanism.name);
  return names;
}

}  // namespace raytube
