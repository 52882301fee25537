#include "output/files/unlisted_results.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

#include "core/json.h"
#include "output/files/sha256.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t length_of_a_head = 8192;  // [bytes]

std::string head_of(const fs::path& file) {
  if (std::error_code ignored; !fs::is_regular_file(file, ignored)) return {};
  std::string head(length_of_a_head, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

struct Family {
  const char* table;
  std::string_view phrase;  // in the table's head
  std::vector<const char*> others;
};

const std::array<Family, 3> families = {
    {{"converge.csv", "\n# norm: sqrt(sum |S|^2) over all rows and channels; ", {"converge.png", "converge.svg"}},
     {"compare.csv", "\nchannel,result_peak_dbsm,reference_peak_dbsm,", {"compare.png", "compare.svg"}},
     {"sources.csv",
      "\nposition,x_m,y_m,z_m,model,rays_asked,rays,part,",
      {"hits.ply", "launch.png", "launch.svg", "hits.png", "hits.svg", "sources.png", "sources.svg"}}}};

// Nothing unless rcs.csv is the one that run.json was written with.
std::optional<JsonValue> case_of_run(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "run.json") || !fs::is_regular_file(folder / "rcs.csv")) return {};
  std::ifstream in(folder / "run.json", std::ios::binary);
  const std::optional<JsonValue> json = parsed_json({std::istreambuf_iterator<char>(in), {}});
  if (!json) return {};
  const JsonValue *program = json->find("program"), *sha256 = json->find("rcs_csv_sha256"), *resolved = json->find("case");
  if (!program || program->text != "raytube" || !sha256 || !resolved || resolved->kind != JsonValue::Kind::table) return {};
  return sha256->text == sha256_of_file(folder / "rcs.csv") ? std::optional(*resolved) : std::nullopt;
}

// What a run with this resolved case writes. It does not say whether parts.csv or random.csv were asked for, or whether a cut
// went all round: their heads do. Nothing if the case has another type of output than a run writes there.
std::set<std::string> results_of_run(const fs::path& folder, const JsonValue& resolved) {
  const JsonValue* output = resolved.find("output");
  if (output && output->kind != JsonValue::Kind::table) return {};
  std::set<std::string> names = {"rcs.csv", "channels.csv", "run.json"};
  for (const char* table : {"parts.csv", "random.csv"})
    if (head_of(folder / table).starts_with("# Time factor exp(+j omega t); a wave travels as exp(-j k r).")) names.insert(table);
  const JsonValue* plots = output ? output->find("plots") : nullptr;
  if (plots && plots->boolean) names.insert({"rcs.png", "rcs.svg"});
  for (const std::string picture : {"rcs_polar", "parts"})
    if (plots && plots->boolean && head_of(folder / (picture + ".svg")).find("Produced by GNUPLOT") != std::string::npos)
      names.insert({picture + ".png", picture + ".svg"});
  const JsonValue* netcdf = output ? output->find("netcdf") : nullptr;
  if (netcdf && netcdf->boolean) names.insert("rcs.nc");
  if (output && output->find("image_look")) names.merge(names_of_images(folder));
  return names;
}

// image.csv, image_3_mesh.vtu, image_12_phase.png, image.pvd and the like.
bool is_image(std::string_view name) {
  constexpr std::array<std::string_view, 5> endings = {".csv", "_mesh.vtu", ".png", "_phase.png", "_window.png"};
  if (!name.starts_with("image")) return false;
  if (name == "image.pvd") return true;
  name.remove_prefix(5);
  const std::size_t end = std::min(name.find_first_not_of("0123456789", 1), name.size());
  if (name.starts_with('_') && end > 1) name.remove_prefix(end);
  return std::ranges::find(endings, name) != endings.end();
}

}  // namespace

std::set<std::string> names_of_images(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string(); is_image(name)) names.insert(name);
  return names;
}

std::set<std::string> unlisted_results(const fs::path& folder, const std::function<bool(const std::string&)>& listed) {
  std::set<std::string> names;
  for (const Family& family : families) {
    if (listed(family.table) || head_of(folder / family.table).find(family.phrase) == std::string::npos) continue;
    names.insert(family.table);
    names.insert(family.others.begin(), family.others.end());
  }
  if (listed("run.json")) return names;
  try {
    if (const std::optional<JsonValue> resolved = case_of_run(folder)) names.merge(results_of_run(folder, *resolved));
  } catch (const std::runtime_error&) {
    // What cannot be read is nobody's result.
  }
  return names;
}

}  // namespace raytube
