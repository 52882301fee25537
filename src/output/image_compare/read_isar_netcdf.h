// The netCDF file of raytube isar as an image.
#pragma once

#include "output/image_compare/pixel_image.h"

namespace raytube {

bool is_isar_netcdf(const std::filesystem::path& file);

/// Cross-range across, range up. Throws InputError for an image in space.
PixelImage read_isar_netcdf(const std::filesystem::path& file);

}  // namespace raytube
