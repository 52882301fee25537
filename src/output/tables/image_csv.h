// The image of a look as a table.
#pragma once

#include <filesystem>

#include "scene/image.h"
#include "scene/sweep.h"

namespace raytube {

/// One row per cell: complex S, sigma and phase of the four channels.
void write_image_csv(const std::filesystem::path& file, const Sweep& sweep, const LookImage& image);

}  // namespace raytube
