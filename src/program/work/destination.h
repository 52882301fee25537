// Where a command writes its results, and where it finds those that it reads.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>

namespace raytube {

/// A folder, or one netCDF file in it.
struct Destination {
  std::filesystem::path folder;
  std::string file;  // empty: all files

  bool one_file() const { return !file.empty(); }
  std::string text() const { return (one_file() ? folder / file : folder).string(); }
};

/// The destination that -o names, else the usual folder. Throws InputError for the name of a table; its sentence names `table` as
/// one of the results.
Destination destination_of(const std::filesystem::path& asked, const std::filesystem::path& usual, const char* table);

/// The files with the rows of a run, the fuller one first.
inline constexpr std::array<const char*, 2> result_names = {"rcs.nc", "rcs.csv"};

/// The given file, or in the folder of a run the first of `names` that it holds. Throws InputError for a folder without them.
std::filesystem::path result_in(const std::filesystem::path& given, std::span<const char* const> names = result_names);

}  // namespace raytube
