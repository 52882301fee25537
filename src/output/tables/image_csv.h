// The image of a look as a table.
#pragma once

#include <filesystem>

#include "scene/image.h"
#include "scene/sweep.h"

namespace raytube {

/// One row per cell of the image: complex S [m], sigma [dBsm] and phase [rad] of the four channels. Throws std::runtime_error if
/// the disk does not take it.
void write_image_csv(const std::filesystem::path& file, const Sweep& sweep, const LookImage& image);

}  // namespace raytube
