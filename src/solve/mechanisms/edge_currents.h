// Fringe currents of edges, and what these start at further edges and along plates, as mechanisms (utd/fringe, utd/multiple,
// utd/corner).
#pragma once

#include <memory>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"

namespace raytube {

/// Of edges between perfect conductors.
std::unique_ptr<Mechanism> make_edge_currents(const BandScene& scene);
double edge_currents_bytes(const SolvePlan& plan);

/// Of all other edges, by a heuristic.
std::unique_ptr<Mechanism> make_material_edges(const BandScene& scene);

/// How long all edges that may add to S are together, per frequency of the band [m].
std::vector<double> edge_lengths(const BandScene& scene);

}  // namespace raytube
