// Which coats and sheets are thicker than what they are on.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"
#include "scene/thick_layers.h"

namespace raytube {

/// By component and material. A coat lies inside its mesh, a sheet half inside: a body must be wider than that, twice as wide as
/// a coat all over it. A facet of a surface is taken as part of an infinite plane: it must be wider than its layers are thick.
std::vector<ThickLayers> find_thick_layers(const TriangleMesh& mesh, std::span<const Material> materials);

}  // namespace raytube
