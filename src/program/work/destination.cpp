#include "program/work/destination.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "output/netcdf/netcdf_file.h"

namespace raytube {

namespace fs = std::filesystem;

Destination destination_of(const fs::path& asked, const fs::path& usual, const char* table) {
  if (asked.empty()) return {usual, ""};
  if (std::error_code unreadable; fs::is_directory(asked, unreadable)) return {asked, ""};
  if (lower_case(asked.extension().string()) == ".csv")
    throw InputError(fmt::format("-o {}: results are a folder of files, {} among them, or one netCDF file; write -o DIR or -o {}",
                                 asked.string(), table, fs::path(asked).replace_extension(".nc").string()));
  if (!is_netcdf_name(asked)) return {asked, ""};
  return {fs::absolute(asked).parent_path(), asked.filename().string()};
}

}  // namespace raytube
