// Results of versions that left no list of them.
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string_view>

#include "output/files/earlier_results.h"
#include "output/files/files.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

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
     {"compare.csv", "\nchannel,result_peak_dbsm,reference_peak_dbsm,rows,", {"compare.png", "compare.svg"}},
     {"sources.csv",
      "\nposition,x_m,y_m,z_m,model,rays_asked,rays,part,",
      {"hits.ply", "launch.png", "launch.svg", "hits.png", "hits.svg", "sources.png", "sources.svg"}}}};

// Null unless rcs.csv is the one that run.json was written with.
Json case_of_run(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "run.json")) return {};
  std::ifstream in(folder / "run.json");
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object() || json.value("program", Json()) != "raytube" || !fs::is_regular_file(folder / "rcs.csv")) return {};
  return json.value("rcs_csv_sha256", Json()) == sha256_of_file(folder / "rcs.csv") ? json.value("case", Json()) : Json();
}

// What a run with this resolved case writes. It does not say whether parts.csv or random.csv were asked for: their heads do.
std::set<std::string> results_of_run(const fs::path& folder, const Json& resolved) {
  std::set<std::string> names = {"rcs.csv", "channels.csv", "run.json"};
  for (const char* table : {"parts.csv", "random.csv"})
    if (head_of(folder / table).starts_with("# Time factor exp(+j omega t); a wave travels as exp(-j k r).")) names.insert(table);
  const Json output = resolved.value("output", Json::object());
  if (output.value("plots", Json()) == true) names.insert({"rcs.png", "rcs.svg"});
  if (output.contains("image_look")) names.merge(names_of_images(folder));
  return names;
}

}  // namespace

std::set<std::string> names_of_images(const fs::path& folder) {
  static const std::regex image(R"(image(_\d+)?(\.csv|_mesh\.vtu|(_phase|_window)?\.png))");
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string(); std::regex_match(name, image)) names.insert(name);
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
    if (const Json resolved = case_of_run(folder); resolved.is_object()) names.merge(results_of_run(folder, resolved));
  } catch (const std::runtime_error&) {
    // What cannot be read is nobody's result.
  } catch (const Json::exception&) {
    // Nor is what has another type than a run writes there.
  }
  return names;
}

}  // namespace raytube
