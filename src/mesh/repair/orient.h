// Consistent winding, connected components, and which of them are closed.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/geometry.h"
#include "mesh/model/triangle_mesh.h"

namespace raytube {

struct Surfaces {
  std::vector<std::uint32_t> triangle_component;
  std::vector<Component> components;  // in order of their first triangles
};

/// Winds the triangles of each component alike: closed components outward, open ones as most of their triangles were.
/// Components end where more than two triangles meet at an edge, so that a fin on a box is one of its own, unless pieces make
/// a closed body together. A component is closed if its borders cancel in opposite pairs and it is thicker than `distance`.
/// Fills triangles_flipped and components_nearly_closed of the report.
Surfaces orient(std::span<const dvec3> vertices, std::vector<Triangle>& triangles, double distance, MeshReport& report);

}  // namespace raytube
