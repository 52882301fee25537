// Images of several looks as one series, for ParaView.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace raytube {

/// A file of a series, by its name in the folder of the series, and the look that it shows.
struct SeriesFile {
  std::size_t look;
  std::string name;
};

/// A ParaView collection (.pvd): the look is the time.
void write_image_pvd(const std::filesystem::path& file, std::span<const SeriesFile> files);

}  // namespace raytube
