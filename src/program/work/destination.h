// Where a command's results go.
#pragma once

#include <filesystem>
#include <string>

namespace raytube {

/// A folder, or one netCDF file alone in it.
struct Destination {
  std::filesystem::path folder;
  std::string file;  // empty: all files

  bool one_file() const { return !file.empty(); }
  std::string text() const { return (one_file() ? folder / file : folder).string(); }
};

/// What -o names, or the usual folder without it. Throws InputError for the name of a table: `table` is one of the results.
Destination destination_of(const std::filesystem::path& asked, const std::filesystem::path& usual, const char* table);

}  // namespace raytube
