// Parts of a mesh that stand at several places.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "mesh/read/formats.h"

namespace raytube {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Appends a part of a file at a place: its vertices moved, in double, and its triangles by these names. A mirrored part is wound
/// the other way, so that its outside stays outside. `bytes` is the size of the file with those it names. Throws InputError if a
/// corner is none of the points, or if more comes of the file than any target has.
void add_instance(const MeshFile& file, std::uintmax_t bytes, const std::vector<glm::dvec3>& points, const Triangles& triangles,
                  const glm::dmat4& place, const std::vector<std::string>& names, PolygonSoup& soup);

}  // namespace raytube
