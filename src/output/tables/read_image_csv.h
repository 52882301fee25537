// image.csv, read back.
#pragma once

#include <filesystem>

#include "scene/image.h"

namespace raytube {

/// Lattice and cells of an image, as write_image_csv has them; blocks of s x s cells are one, with their sum, s the smallest
/// number that leaves at most `most_across` along either side. Throws InputError for a file that raytube has not written.
LookImage read_image_csv(const std::filesystem::path& file, std::uint32_t most_across);

}  // namespace raytube
