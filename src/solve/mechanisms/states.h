// Whether each mechanism takes part in a plan, and why not: known without any of them being made.
#pragma once

#include "plan/plan.h"

namespace raytube {

/// Waves over curved surfaces.
MechanismState surface_waves_state(const SolvePlan& plan);
/// The same in one band.
bool has_surface_waves(const SolvePlan& plan, const BandPlan& band);
/// Whether they run over curved surfaces of every material there is.
bool waves_run_over_all_materials(const SolvePlan& plan);

MechanismState edge_currents_state(const SolvePlan& plan);

MechanismState interaction_state(const SolvePlan& plan);
/// The same in one band.
bool interacts(const SolvePlan& plan, const BandPlan& band);

}  // namespace raytube
