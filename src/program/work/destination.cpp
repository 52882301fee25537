#include "program/work/destination.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "output/netcdf/netcdf_file.h"

namespace raytube {

namespace fs = std::filesystem;

Destination destination_of(const fs::path& asked, const fs::path& usual, const char* table) {
  if (asked.empty()) return {usual, ""};
  if (std::error_code unreadable; fs::is_directory(asked, unreadable)) return {asked, ""};
  constexpr std::array<std::string_view, 8> other_files = {".csv", ".mat", ".h5", ".hdf5", ".json", ".txt", ".xlsx", ".png"};
  if (std::ranges::find(other_files, lower_case(asked.extension().string())) != other_files.end())
    throw InputError(fmt::format("-o {}: results are a folder of files, {} among them, or one netCDF file; write -o DIR or -o {}",
                                 asked.string(), table, fs::path(asked).replace_extension(".nc").string()));
  if (!is_netcdf_name(asked)) return {asked, ""};
  return {fs::absolute(asked).parent_path(), asked.filename().string()};
}

fs::path result_in(const fs::path& given, std::span<const char* const> names) {
  if (std::error_code unreadable; !fs::is_directory(given, unreadable)) return given;
  for (const char* name : names)
    if (fs::is_regular_file(given / name)) return given / name;
  throw InputError(fmt::format("{}: holds {} {}; give the folder of a raytube run, or the file of a result", given.string(),
                               names.size() > 1 ? "neither" : "no", fmt::join(names, " nor ")));
}

}  // namespace raytube
