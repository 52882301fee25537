// Mesh files compressed with gzip.
#pragma once

#include <cstdint>

#include "mesh/files/mesh_file.h"

namespace raytube {

/// The file unpacked, under its own name. Throws InputError: no gzip data, damaged, cut short, more than `most_bytes`, or so
/// many times the bytes there are that it is no mesh.
MeshFile unpacked(const MeshFile& file, std::uintmax_t most_bytes);

}  // namespace raytube
