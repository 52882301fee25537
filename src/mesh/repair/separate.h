// Bodies that touch along edges, taken apart.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/geometry.h"

namespace raytube {

struct SeparateSoup {
  std::vector<Triangle> triangles;       // those given, with corners in copies of the vertices
  std::vector<std::uint32_t> vertex_of;  // copy -> vertex
};

/// Triangles stay together at an edge that has two of them, and, where more meet, in pairs that turn their backs to one
/// another with nothing in between: the two that bound a solid there, if the winding is right.
SeparateSoup separate_bodies(std::span<const dvec3> vertices, std::span<const Triangle> triangles);

}  // namespace raytube
