// The contributions to S on the surface of the target, for ParaView.
#pragma once

#include <array>
#include <filesystem>
#include <span>

#include "scene/image.h"

namespace raytube {

/// A VTK unstructured grid (XML, .vtu) of the target's triangles and of the lit edges as lines. Cell data: re_pq and im_pq [m],
/// sigma_pq_dbsm, and `edge`, 1 for lines; all cells together add up to S. Vertices in the mesh's own coordinates [m].
void write_image_vtu(const std::filesystem::path& file, std::span<const dvec3> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles, const LookImage& image);

}  // namespace raytube
