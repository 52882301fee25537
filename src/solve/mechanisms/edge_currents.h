// Fringe currents of edges, and what these start at further edges and along plates, as mechanisms (utd/fringe, utd/multiple,
// utd/corner).
#pragma once

#include <memory>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"

namespace raytube {

std::unique_ptr<Mechanism> make_edge_currents(const BandScene& scene);
double edge_currents_bytes(const SolvePlan& plan);
void tell_edge_currents(const SolvePlan& plan, const Contribution& edges, std::size_t frequency, RowEvidence& row);

}  // namespace raytube
