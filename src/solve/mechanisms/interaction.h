// Edge-face interaction as a mechanism (utd/interaction).
#pragma once

#include <memory>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"

namespace raytube {

std::unique_ptr<Mechanism> make_interaction(const BandScene& scene);
/// Of the target, and of each look under way.
double interaction_bytes(const SolvePlan& plan);
double interaction_look_bytes(const SolvePlan& plan);

/// What edge-face interaction may leave and take beside tubes and edges whose counted work is given (core/work.h).
InteractionLimits interaction_limits(const SolvePlan& plan, const TubeSums& tubes, double edge_work);

}  // namespace raytube
