// Edges beside other materials than perfect conductors.
#pragma once

#include <span>

#include "scene/material.h"
#include "scene/sweep.h"
#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/edge_scene.h"

namespace raytube {

/// Whether this wedge is one: convex, with a face that is not a perfect conductor.
bool is_material_edge(const Wedge& wedge);

/// Adds to `sum` the fringe currents at first order of all material edges whose faces let nothing through, as wedges of impedance
/// faces (utd/impedance); those of sheets add nothing. Plane waves only; `frequencies` [Hz] are those for which the materials are
/// tabulated.
void add_material_edges(EdgeLookResult& sum, const EdgeScene& scene, std::span<const Material> materials, const Look& look,
                        std::span<const double> frequencies, bool receiver_shadow);

}  // namespace raytube
