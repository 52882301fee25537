// Edge-face interaction as a mechanism (utd/interaction).
#pragma once

#include <memory>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"
#include "solve/mechanisms/state.h"

namespace raytube {

MechanismState interaction_state(const SolvePlan& plan);
std::unique_ptr<Mechanism> make_interaction(const BandScene& scene);
/// Of the target, and of each look under way.
double interaction_bytes(const SolvePlan& plan);
double interaction_look_bytes(const SolvePlan& plan);

/// Whether there is any in the band.
bool interacts(const SolvePlan& plan, const BandPlan& band);

/// What edge-face interaction may leave and take beside tubes and edges whose counted work is given (core/work.h).
InteractionLimits interaction_limits(const SolvePlan& plan, const TubeSums& tubes, double edge_work);

}  // namespace raytube
