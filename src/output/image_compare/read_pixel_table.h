// A table with a row for each pixel as an image.
#pragma once

#include "output/image_compare/pixel_image.h"

namespace raytube {

bool is_pixel_table(const NamedFile& source);
PixelImage read_pixel_table(const NamedFile& source);

}  // namespace raytube
