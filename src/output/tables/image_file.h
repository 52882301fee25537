// Which files hold images: what stands in rows and columns of pixels, not looks.
#pragma once

#include <filesystem>

#include "output/tables/column_map.h"

namespace raytube {

/// By its ending an OpenEXR file; a netCDF file with the dimension cross_range_m; a table whose columns, or names in the map,
/// place pixels: u_m and v_m, cross_range_m and range_m, col and row, or x and y where no column is a frequency or an angle.
bool is_image_file(const std::filesystem::path& file, const ColumnMap& map);

}  // namespace raytube
