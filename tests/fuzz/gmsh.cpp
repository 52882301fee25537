#include "mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return raytube::fuzz::read_mesh(raytube::parse_gmsh, data, size);
}
