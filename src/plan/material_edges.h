// Edges of other things than bare perfect conductors: of materials, and of metal plates whatever they are coated with.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/features/thin_plates.h"
#include "plan/target.h"
#include "scene/sweep.h"

namespace raytube {

/// Convex edges beside other materials than perfect conductors.
struct MaterialEdgeCount {
  std::size_t all = 0;
  std::size_t of_solids = 0;  // add nothing
  std::size_t known = 0;      // whose currents there is a theory for (utd/fringe/material_edges.h) at one of the frequencies
  std::size_t computed = 0;   // all of these, or none as asked
};

MaterialEdgeCount count_material_edges(const Target& target, const Sweep& sweep, const EdgeOptions& asked);

/// The thin-plate edges of metal plates, bare or, if these count, with coats on their sides: the effectively thinnest first.
std::vector<ThinPlateEdge> metal_plate_edges(std::span<const ThinPlateEdge> edges, std::span<const Material> materials,
                                             bool coats_count);

}  // namespace raytube
