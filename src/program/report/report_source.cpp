#include "program/report/report_source.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "output/tables/tables_beside.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

fs::path result_file(const fs::path& given) {
  if (!fs::exists(given))
    throw InputError(fmt::format("{}: is not there; give the folder of a run, or its rcs.csv or netCDF file", given.string()));
  if (!fs::is_directory(given)) return given;
  for (const char* name : {"rcs.csv", "rcs.nc"})
    if (fs::is_regular_file(given / name)) return given / name;
  throw InputError(fmt::format("{}: holds neither rcs.csv nor rcs.nc; give the folder of a raytube run", given.string()));
}

void require_readable_run(const fs::path& result) {
  if (lower_case(result.extension().string()) == ".toml")
    throw InputError(fmt::format("{}: is a case, not a result; run it first (raytube run)", result.string()));
  const fs::path file = fs::absolute(result).parent_path() / "run.json";
  if (!fs::exists(file)) return;
  const std::optional<JsonValue> run = run_of(result);
  if (!run || run->kind != JsonValue::Kind::table)
    throw InputError(fmt::format("{}: is no JSON as a run writes it; run the case again, or delete the file", file.string()));
}

// Of a netCDF file, whose attributes are members of run.json.
JsonValue run_of_attributes(const StoredResult& result) {
  JsonValue run;
  for (const auto& [name, text] : result.attributes) {
    if (name == "raytube_version") run["version"] = text;
    for (const char* known : {"case", "warnings", "counts", "model_uncertainty"})
      if (name == known)
        if (std::optional<JsonValue> value = parsed_json(text)) run[name] = *value;
  }
  return run;
}

void read_parts(ReportSource& source) {
  const fs::path file = fs::absolute(source.file).parent_path() / "parts.csv";
  StoredResult& result = source.product.result;
  if (!result.parts.empty()) return;
  if (fs::exists(file))
    result.parts = read_parts_csv(file, result);
  else
    source.notes.emplace_back("Curves by mechanism: the run kept its mechanisms together; raytube run --parts keeps them apart.");
}

void read_incoherent(ReportSource& source) {
  const fs::path file = fs::absolute(source.file).parent_path() / "incoherent.csv";
  StoredResult& result = source.product.result;
  if (result.incoherent_m2.empty() && fs::exists(file)) result.incoherent_m2 = read_incoherent_csv(file, result);
}

}  // namespace

ReportSource report_source(const Request& request) {
  ReportSource source;
  source.file = result_file(request.result);
  require_readable_run(source.file);
  Request of_file = request;
  of_file.result = source.file;
  source.product = product_source(of_file, [](const ProductSource&) {});
  source.product.name = source.file.filename().string();  // in sentences on the page, which may lie elsewhere
  const std::optional<JsonValue> run = run_of(source.file);
  source.run = run ? *run : run_of_attributes(source.product.result);
  read_parts(source);
  read_incoherent(source);
  return source;
}

}  // namespace raytube
