// Edges beside other materials than perfect conductors, by a heuristic.
#pragma once

#include <span>

#include "scene/material.h"
#include "scene/sweep.h"
#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/edge_scene.h"

namespace raytube {

/// Whether the heuristic gives this wedge a current: a convex one with a face that is not a perfect conductor.
bool is_material_edge(const Wedge& wedge);

/// Adds to `sum` the fringe currents at first order on all material edges: of the terms of
/// each face of a perfect conductor, those that make up for the jump at the shadow boundary are times what the face blocks, those
/// at the reflection boundary times what it reflects (Luebbers 1984, IEEE Trans. AP-32, 70, for opaque wedges; Burnside &
/// Burgener 1983, IEEE Trans. AP-31, 104, for thin sheets). Valid where the edge is met at about a right angle, as E and H along
/// it are TE and TM waves of the faces then. No surface wave is in it. Plane waves only; `frequencies` [Hz] are those for which
/// the materials are tabulated.
void add_material_edges(EdgeLookResult& sum, const EdgeScene& scene, std::span<const Material> materials, const Look& look,
                        std::span<const double> frequencies, bool receiver_shadow);

}  // namespace raytube
