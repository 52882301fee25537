// Includes run one way only: base <- mesh <- { sbr, utd } <- solve <- case <- program; output knows only the base.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

namespace {

namespace fs = std::filesystem;

const fs::path source = RAYTUBE_SOURCE_DIR "/src";

// Room of a file: its folder; in src/ itself, solve or what everything may use.
std::string room_of(const fs::path& relative) {
  if (relative.has_parent_path()) return relative.begin()->string();
  return relative.stem().string().starts_with("solve") || relative.stem() == "yardstick" ? "solve" : "base";
}

const std::map<std::string, std::set<std::string>> may_include = {
    {"base", {"base"}},
    {"mesh", {"base", "mesh"}},
    {"sbr", {"base", "mesh", "sbr"}},
    {"utd", {"base", "mesh", "utd"}},
    {"solve", {"base", "mesh", "sbr", "utd", "solve"}},
    {"output", {"base", "output"}},
    {"case", {"base", "mesh", "sbr", "utd", "solve", "case"}},
    {"program", {"base", "mesh", "sbr", "utd", "solve", "case", "output", "program"}},
};

TEST(Layers, NoArrowBack) {
  const std::regex include(R"re(^\s*#include\s+"([^"]+)")re");
  int checked = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source)) {
    const fs::path file = fs::relative(entry.path(), source);
    if (file.extension() != ".h" && file.extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      ++checked;
      EXPECT_TRUE(may_include.at(room_of(file)).contains(room_of(match[1].str()))) << file << " includes " << match[1];
    }
  }
  EXPECT_GT(checked, 50);
}

// Two types of one name that never meet in a source file get past the compiler, and the linker mixes up their functions.
TEST(Layers, TypesInHeadersHaveOneDefinition) {
  const std::regex definition(R"(^(?:struct|class|enum class) (?:alignas\(\d+\) )?(\w+)(?: final)?(?: :.*)? \{)");
  std::map<std::string, fs::path> defined_in;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source)) {
    if (entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, definition)) continue;
      const auto& [name, is_new] = defined_in.emplace(match[1], entry.path());
      EXPECT_TRUE(is_new) << match[1] << ": " << entry.path() << " and " << name->second;
    }
  }
  EXPECT_GT(defined_in.size(), 100);
}

TEST(Layers, ForeignLibrariesStayOutOfHeaders) {
  const std::regex foreign(R"(#include\s+<(embree|CGAL|OpenMesh|CLI|toml|nlohmann|openssl))");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source)) {
    if (entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);)
      EXPECT_FALSE(std::regex_search(line, foreign)) << entry.path() << ": " << line;
  }
}

}  // namespace
