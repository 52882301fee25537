// Wedges as lines, for ParaView.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "scene/wedge_line.h"

namespace raytube {

/// The first line of such a file.
inline constexpr std::string_view wedges_vtp_head =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><!-- wedges of raytube -->\n";

/// VTK poly data (XML, .vtp), a line a wedge. Cell data as the columns of wedges_csv: wedge, length_m, interior_deg, n,
/// face1_patch, face2_patch, lit_fraction, thickness_m.
void write_wedges_vtp(const std::filesystem::path& file, std::span<const WedgeLine> wedges);

}  // namespace raytube
