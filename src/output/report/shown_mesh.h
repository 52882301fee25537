// A mesh coarse enough to be looked at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

struct ShownMesh {
  std::vector<dvec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> shown_as;  // [triangle given]: that of `triangles` which stands for it
};

/// With at most so many triangles: the mesh itself, or else one whose vertices are the means of those in each cell of a grid, the
/// finest that is coarse enough. (Rossignac & Borrel, Multi-resolution 3D approximations, 1993: vertex clustering.)
ShownMesh shown_mesh(std::span<const dvec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t most);

}  // namespace raytube
