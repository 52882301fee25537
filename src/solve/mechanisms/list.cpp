#include "solve/mechanisms/list.h"

#include "solve/mechanisms/edge_currents.h"
#include "solve/mechanisms/interaction.h"
#include "solve/mechanisms/states.h"
#include "solve/mechanisms/surface_waves.h"

namespace raytube {

namespace {

constexpr std::array<MechanismEntry, mechanism_count> list{{
    {MechanismId::surface_waves, ScatteringMechanism::surface_waves, "waves over curved surfaces", "surfaces.waves",
     surface_waves_state, make_surface_waves, surface_waves_bytes},
    {MechanismId::edge_currents, ScatteringMechanism::edges, "edge currents", "edges.method", edge_currents_state,
     make_edge_currents, edge_currents_bytes},
    {MechanismId::interaction, ScatteringMechanism::interaction, "edge-face interaction", "edges.between", interaction_state,
     make_interaction, interaction_bytes, interaction_look_bytes},
}};

}  // namespace

std::span<const MechanismEntry> mechanism_list() { return list; }

const MechanismEntry& entry_of(MechanismId id) { return list[static_cast<std::size_t>(id)]; }

}  // namespace raytube
