// Vertices that lie together become one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

struct WeldedPoints {
  std::vector<dvec3> vertices;
  std::vector<std::uint32_t> vertex_of_point;
};

/// Taken in order, each point joins the first kept vertex within `distance` of it, or is kept as a new vertex where it is; so
/// the vertices are more than `distance` apart. `diagonal` is that of the points' bounding box; all in one unit.
WeldedPoints weld(std::span<const dvec3> points, double distance, double diagonal);

}  // namespace raytube
