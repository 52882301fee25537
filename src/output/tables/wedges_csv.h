// A list of wedges as a table.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "scene/wedge_line.h"

namespace raytube {

/// The header of such a table.
inline constexpr std::string_view wedges_csv_head =
    "wedge,x1_m,y1_m,z1_m,x2_m,y2_m,z2_m,length_m,interior_deg,n,face1_patch,face2_patch,lit_fraction,thickness_m\n";

/// One row a wedge.
void write_wedges_csv(const std::filesystem::path& file, std::span<const WedgeLine> wedges);

}  // namespace raytube
