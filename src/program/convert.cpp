// raytube convert: rcs.csv -> netCDF and back.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/text.h"
#include "output/files/earlier_results.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "program/options.h"
#include "program/work/destination.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* convert_examples =
    R"(There and back gives the same numbers bit for bit, and the same bytes for a table that raytube has written. A table holds
no parts and no attributes. Replaces only files that raytube has written.

Examples:
  raytube convert out/rcs.csv rcs.nc
  raytube convert rcs.nc rcs.csv)";

struct ConvertRequest {
  fs::path from, to;
};

bool is_csv_name(const fs::path& file) { return lower_case(file.extension().string()) == ".csv"; }

// Throws InputError unless one is a table and the other a netCDF file.
void check_suffixes(const fs::path& from, const fs::path& to) {
  for (const fs::path& file : {from, to})
    if (!is_csv_name(file) && !is_netcdf_name(file))
      throw InputError(fmt::format("{}: its name ends neither in .csv nor in .nc; name one of each", file.string()));
  if (is_csv_name(from) == is_csv_name(to))
    throw InputError(
        fmt::format("{} and {} are of the same kind; convert a .csv to a .nc, or a .nc to a .csv", from.string(), to.string()));
}

// Only the result of an earlier command may be replaced.
void check_place(const fs::path& to, const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(fmt::format("{}: cannot be written, because its folder does not exist; create it first", to.string()));
  if (!fs::exists(fs::symlink_status(to)) || EarlierResults(folder).hold(to.filename().string())) return;
  throw InputError(
      fmt::format("{}: exists, and is not a file that raytube has written; name another file, or delete it", to.string()));
}

StoredResult read_stored(const fs::path& file) {
  if (is_netcdf_name(file)) return read_netcdf(file);
  StoredResult result = read_rcs_csv(file);
  result.attributes = {{"rcs_csv_sha256", sha256_of_file(file)}};
  return result;
}

void convert_file(const ConvertRequest& asked) {
  const fs::path& to = asked.to;
  const char* other_kind = is_netcdf_name(to) ? "rcs.csv" : "rcs.nc";
  const fs::path from = result_in(asked.from, std::span(&other_kind, 1));
  check_suffixes(from, to);
  const fs::path parent = fs::absolute(to).parent_path();
  check_place(to, parent);
  const ResultNames names{{}, {to.filename().string()}};
  check_output(parent, names, {{"the file to convert", from}});
  const StoredResult result = read_stored(from);
  AllOrNothing(parent).place(names, [&](const fs::path& folder) {
    is_netcdf_name(to) ? write_netcdf(folder / to.filename(), result) : write_rcs_csv(folder / to.filename(), result);
    stop_if_interrupted();
  });
}

}  // namespace

CLI::App& add_convert(CommandLine& line) {
  const auto asked = std::make_shared<ConvertRequest>();
  CLI::App& convert = add_command(line, "convert", "Convert rcs.csv to netCDF, or back", convert_examples);
  add_value(convert, "from A.csv|A.nc", asked->from, "Input file")->required();
  add_value(convert, "to B.nc|B.csv", asked->to, "Output file")->required();
  return set_action(line, convert, [asked] { convert_file(*asked); });
}

}  // namespace raytube
