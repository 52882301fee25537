// The bytes of a mesh file, read by the parser of one format and, if not too much comes of them, built.
#pragma once

#include "core/error.h"
#include "mesh/read/formats.h"
#include "target.h"

namespace raytube::fuzz {

int read_mesh(MeshParser parse, const std::uint8_t* data, std::size_t size);

}  // namespace raytube::fuzz
