// Edges beside other materials than perfect conductors.
#pragma once

#include <cstddef>
#include <span>

#include "mesh/features/wedges.h"
#include "scene/material.h"

namespace raytube {

/// Convex ones.
struct MaterialEdgeCount {
  std::size_t all = 0;
  std::size_t of_solids = 0;  // add nothing
  std::size_t known = 0;      // whose currents there is a theory for (utd/fringe/material_edges.h) at one of the frequencies
};

MaterialEdgeCount count_material_edges(std::span<const Wedge> wedges, std::span<const Material> materials,
                                       std::span<const double> frequencies);

}  // namespace raytube
