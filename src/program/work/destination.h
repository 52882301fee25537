// Where a command's results go, and where those lie that it reads.
#pragma once

#include <array>
#include <filesystem>
#include <span>
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

/// What a run leaves of its rows: the file with most in it first.
inline constexpr std::array<const char*, 2> result_names = {"rcs.nc", "rcs.csv"};

/// The file of a result that is given as such, or as the folder of a run: there the first of `names`. Throws InputError for a
/// folder without any.
std::filesystem::path result_in(const std::filesystem::path& given, std::span<const char* const> names = result_names);

}  // namespace raytube
