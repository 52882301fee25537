// Rays over curved surfaces, for ParaView.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "scene/surface_rays.h"

namespace raytube {

/// The first line of such a file.
inline constexpr std::string_view surface_rays_head =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><!-- surface rays of raytube -->\n";

/// VTK poly data (XML, .vtp), a line a ray, positions as given [m]. Point data: arc_length in wavelengths, xi, width, hard, soft
/// (SurfaceRayPoint). Cell data: kind, 0 into the dark, 1 from an edge; order.
void write_surface_rays_vtp(const std::filesystem::path& file, std::span<const SurfaceRay> rays, double wavelength);

}  // namespace raytube
