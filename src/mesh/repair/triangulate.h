// Polygons -> triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/model/geometry.h"

namespace raytube {

/// Splits a polygon into corners - 2 triangles: a fan from the first corner where that covers it, ears otherwise. A corner
/// equal to the one before it is left out. Empty if fewer than three distinct corners are left.
std::vector<Triangle> triangulate(std::span<const dvec3> points, std::vector<std::uint32_t> polygon);

}  // namespace raytube
