// Mesh file -> TriangleMesh: mesh/read finds the polygons, mesh/repair makes a mesh of them.
//
// Rooms of mesh/, each includes only from those before it: model, files <- { read, repair, trace, soundness } <- features <- mesh
// itself.
#pragma once

#include <filesystem>

#include "mesh/read/read_mesh.h"
#include "mesh/repair/build_mesh.h"

namespace raytube {

/// Reads a file as read_polygon_soup does and mends it as build_mesh does; throws what these throw.
LoadedMesh load_mesh(const std::filesystem::path& file, double metres_per_unit);

}  // namespace raytube
