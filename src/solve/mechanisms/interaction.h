// Edge-face interaction as a mechanism (utd/interaction).
#pragma once

#include <memory>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"

namespace raytube {

/// Why pairs of an edge and a face are left out that might matter.
inline constexpr const char* beyond_budget = "beyond edges.between_budget";

std::unique_ptr<Mechanism> make_interaction(const BandScene& scene);
/// Of the target, and of each look under way.
double interaction_bytes(const SolvePlan& plan);
double interaction_look_bytes(const SolvePlan& plan);
void tell_interaction(const SolvePlan& plan, const Contribution& interaction, std::size_t frequency, RowEvidence& row);

/// What edge-face interaction may leave and take in a look: the same in all of them, whatever the frequencies, of the counted
/// work (utd/wedge/work.h) that tubes and edges of such a target take.
InteractionLimits interaction_limits(const SolvePlan& plan);

}  // namespace raytube
