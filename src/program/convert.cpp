// raytube convert: rcs.csv -> netCDF and back.
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "output/files/earlier_results.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "program/commands.h"
#include "program/work/destination.h"
#include "program/work/interrupt.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

bool is_csv_name(const fs::path& file) { return lower_case(file.extension().string()) == ".csv"; }

// Throws InputError unless one is a table and the other a netCDF file.
void check_suffixes(const fs::path& from, const fs::path& to) {
  for (const fs::path& file : {from, to})
    if (!is_csv_name(file) && !is_netcdf_name(file))
      throw InputError(fmt::format("{}: its name ends neither with .csv nor with .nc; name one of each", file.string()));
  if (is_csv_name(from) == is_csv_name(to))
    throw InputError(
        fmt::format("{} and {} are of one kind; convert a .csv to a .nc, or a .nc to a .csv", from.string(), to.string()));
}

// A result of an earlier command may be replaced, nothing else.
void check_place(const fs::path& to, const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(fmt::format("{}: cannot be written; its folder does not exist, make it first", to.string()));
  if (!fs::exists(fs::symlink_status(to)) || EarlierResults(folder).hold(to.filename().string())) return;
  throw InputError(
      fmt::format("{}: is there, and is not what raytube has written there; name another file, or delete it", to.string()));
}

StoredResult read_stored(const fs::path& file) {
  if (is_netcdf_name(file)) return read_netcdf(file);
  StoredResult result = read_rcs_csv(file);
  result.attributes = {{"rcs_csv_sha256", sha256_of_file(file)}};
  return result;
}

}  // namespace

void convert_command(const Request& request) {
  const fs::path& to = request.reference;
  const char* other_kind = is_netcdf_name(to) ? "rcs.csv" : "rcs.nc";
  const fs::path from = result_in(request.result, std::span(&other_kind, 1));
  check_suffixes(from, to);
  const fs::path parent = fs::absolute(to).parent_path();
  check_place(to, parent);
  const ResultNames names{{}, {to.filename().string()}};
  check_output(parent, names, {{"the file to convert", from}});
  const StoredResult result = read_stored(from);
  const OutputFolder folder(parent);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  if (is_netcdf_name(to))
    write_netcdf(results.folder() / to.filename(), result);
  else
    write_rcs_csv(results.folder() / to.filename(), result);
  stop_if_interrupted();
  replace_results(results, folder.path(), names, {}, [&ending] { ending.complete(); });
}

}  // namespace raytube
