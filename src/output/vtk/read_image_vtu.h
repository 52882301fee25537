// image_mesh.vtu, read back.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "scene/image.h"

namespace raytube {

/// What write_image_vtu was given.
struct ImageMesh {
  std::vector<dvec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  LookImage image;  // of triangles and edges; which look it is, and cells, are not in such a file
};

/// Throws InputError for a file that raytube has not written.
ImageMesh read_image_vtu(const std::filesystem::path& file);

}  // namespace raytube
