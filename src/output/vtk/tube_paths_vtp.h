// Paths of tubes as lines, for ParaView.
#pragma once

#include <filesystem>
#include <string_view>

#include "scene/tube_paths.h"

namespace raytube {

/// The first line of such a file.
inline constexpr std::string_view tube_paths_head =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><!-- tube paths of raytube -->\n";

/// VTK poly data (XML, .vtp), a line a tube. Cell data: column, row, bounces, area_m2, power_w (for 1 W/m^2), length_m, end
/// (TubeEnd, from 0) and truncated (0 or 1). Point data: bounce, path_length_m, power (share), triangle (-1: none).
void write_tube_paths_vtp(const std::filesystem::path& file, const TubePaths& tubes);

}  // namespace raytube
