// A mesh as bytes, for another process of the same program.
#pragma once

#include <string>
#include <string_view>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// Everything in it.
std::string bytes_of_mesh(const TriangleMesh& mesh);

/// The mesh again. Throws std::runtime_error if the bytes are not those of one.
TriangleMesh mesh_of_bytes(std::string_view bytes);

}  // namespace raytube
