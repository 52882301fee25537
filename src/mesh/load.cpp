#include "mesh/load.h"

namespace raytube {

LoadedMesh load_mesh(const std::filesystem::path& file, double metres_per_unit) {
  return build_mesh(read_polygon_soup(file, metres_per_unit), metres_per_unit, file.string());
}

}  // namespace raytube
