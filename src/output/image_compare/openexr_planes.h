// Pixels of OpenEXR files, channel by channel.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace raytube {

/// Channels as numbers of single precision; whole numbers and halves become those.
struct OpenexrPlanes {
  std::vector<std::string> names;
  std::size_t columns = 0, rows = 0;
  std::vector<std::vector<float>> values;  // [channel][row from the top][column]
};

/// The first part: scan lines, or tiles of full resolution. Channels of fewer pixels (chroma) are left out. Throws InputError.
OpenexrPlanes read_openexr_planes(const std::filesystem::path& file);

}  // namespace raytube
