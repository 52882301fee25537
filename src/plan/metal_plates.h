// Which thin-plate edges are those of metal plates, whatever they are coated with.
#pragma once

#include <span>
#include <vector>

#include "mesh/features/thin_plates.h"
#include "scene/material.h"

namespace raytube {

/// Those of metal plates, bare or, if these count, with coats on their sides: the effectively thinnest first.
std::vector<ThinPlateEdge> metal_plate_edges(std::span<const ThinPlateEdge> edges, std::span<const Material> materials,
                                             bool coats_count);

}  // namespace raytube
