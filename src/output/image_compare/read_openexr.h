// OpenEXR files of renderers as images.
#pragma once

#include "output/image_compare/pixel_image.h"

namespace raytube {

/// Channels, of layers LAYER.NAME, are columns; rows are counted from the lowest one. Throws InputError.
PixelImage read_openexr(const NamedFile& source);

}  // namespace raytube
