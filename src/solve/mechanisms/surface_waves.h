// Waves over curved surfaces as a mechanism (utd/surface).
#pragma once

#include <memory>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"
#include "solve/mechanisms/state.h"

namespace raytube {

MechanismState surface_waves_state(const SolvePlan& plan);
std::unique_ptr<Mechanism> make_surface_waves(const BandScene& scene);
double surface_waves_bytes(const SolvePlan& plan);

/// Whether there are any in the band.
bool has_surface_waves(const SolvePlan& plan, const BandPlan& band);

}  // namespace raytube
