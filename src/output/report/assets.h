// The files of assets/, as the build has made strings of them.
#pragma once

#include <array>
#include <string_view>

namespace raytube {

extern const std::string_view asset_page, asset_style;
extern const std::array<std::string_view, 9> asset_scripts;  // in the order in which they run

}  // namespace raytube
