// Waves over curved surfaces as a mechanism (utd/surface, utd/rounded, utd/tip).
#pragma once

#include <memory>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"

namespace raytube {

std::unique_ptr<Mechanism> make_surface_waves(const BandScene& scene);
double surface_waves_bytes(const SolvePlan& plan);
void tell_surface_waves(const SolvePlan& plan, const Contribution& waves, std::size_t frequency, RowEvidence& row);

}  // namespace raytube
