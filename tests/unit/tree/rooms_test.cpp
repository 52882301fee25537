// The rooms of src/: which may include which, no circle between units, none overfull. A unit is a header and its source file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "scratch.h"

namespace {

namespace fs = std::filesystem;
using raytube::testing::Scratch;
using testing::ElementsAre;
using testing::IsEmpty;

using Findings = std::vector<std::string>;
using Rooms = std::map<std::string, std::set<std::string>>;  // a room, and those that it may include from beside itself

const fs::path source = RAYTUBE_SOURCE_DIR "/src";
constexpr int most_files = 30;

/// What every method may use.
const std::set<std::string> base = {"core",       "math",       "math/special",  "scene",
                                    "mesh/model", "mesh/trace", "mesh/features", "mesh/smooth"};

std::set<std::string> operator+(std::set<std::string> rooms, const std::set<std::string>& others) {
  rooms.insert(others.begin(), others.end());
  return rooms;
}

const Rooms may_include = {
    {"", {}},
    {"core", {}},
    {"math", {"core"}},
    {"math/special", {"core", "math"}},
    {"scene", {"core"}},
    {"scene/keys", {"core", "scene"}},

    {"mesh/model", {"core"}},
    {"mesh/files", {"core"}},
    {"mesh/read", {"core", "mesh/model", "mesh/files"}},
    {"mesh/repair", {"core", "scene", "mesh/model"}},
    {"mesh/trace", {"core", "math", "mesh/model"}},
    {"mesh/features", {"core", "mesh/model", "mesh/trace"}},
    {"mesh/smooth", {"core", "mesh/model", "mesh/features"}},
    {"mesh/soundness", {"core", "scene", "mesh/model"}},
    {"mesh", {"mesh/read", "mesh/repair"}},

    {"sbr/launch", base},
    {"sbr/beams", base + std::set<std::string>{"sbr/launch"}},
    {"sbr/visible", base + std::set<std::string>{"sbr/launch", "sbr/beams"}},
    {"sbr/flat", base + std::set<std::string>{"sbr/launch", "sbr/beams", "sbr/visible"}},
    {"sbr/curved", base + std::set<std::string>{"sbr/launch", "sbr/beams", "sbr/visible"}},
    {"sbr/solid", base + std::set<std::string>{"sbr/launch", "sbr/beams"}},
    {"sbr", base + std::set<std::string>{"sbr/launch", "sbr/beams", "sbr/visible", "sbr/flat", "sbr/curved", "sbr/solid"}},

    {"utd/wedge", base},
    {"utd/rounded", base + std::set<std::string>{"utd/wedge", "utd/surface"}},
    {"utd/shadow", base + std::set<std::string>{"utd/wedge"}},
    {"utd/multiple", base + std::set<std::string>{"utd/wedge", "utd/shadow", "utd/fock", "utd/surface"}},
    {"utd/fock", base + std::set<std::string>{"utd/wedge"}},
    {"utd/surface", base + std::set<std::string>{"utd/wedge", "utd/fock"}},
    {"utd/tip", base + std::set<std::string>{"utd/wedge", "utd/fock", "utd/surface", "utd/corner"}},
    {"utd/corner", base + std::set<std::string>{"utd/wedge"}},
    {"utd/sheet", base + std::set<std::string>{"utd/wedge", "utd/shadow", "utd/multiple"}},
    {"utd/impedance", base + std::set<std::string>{"utd/wedge", "utd/shadow", "utd/multiple"}},
    {"utd/fringe", base + std::set<std::string>{"utd/wedge", "utd/shadow", "utd/surface", "utd/multiple", "utd/corner",
                                                "utd/sheet", "utd/impedance"}},
    {"utd/fan", base + std::set<std::string>{"utd/wedge"}},
    {"utd/interaction", base + std::set<std::string>{"utd/wedge", "utd/shadow", "utd/multiple", "utd/fringe", "utd/fan"}},
    {"utd", base + std::set<std::string>{"utd/wedge", "utd/shadow", "utd/multiple", "utd/fringe", "utd/interaction", "utd/corner"}},

    {"gtd", base + std::set<std::string>{"utd/wedge", "utd/shadow", "utd/fringe"}},

    {"uncertainty", base},

    {"plan", base + std::set<std::string>{"scene/keys", "mesh", "mesh/soundness", "sbr", "sbr/launch", "utd/fringe", "utd/corner", "gtd"}},
    {"solve/mechanisms",
     base + std::set<std::string>{"plan", "sbr", "sbr/beams", "uncertainty", "utd", "utd/fringe", "utd/interaction", "utd/fock",
                                  "utd/rounded", "utd/surface", "utd/tip", "utd/corner"}},
    {"solve", base + std::set<std::string>{"plan", "sbr", "sbr/launch", "sbr/beams", "sbr/curved", "uncertainty", "gtd",
                                           "utd/sheet", "solve/mechanisms"}},

    {"case/data", {"core", "scene", "scene/keys"}},
    {"case/text", {"core", "scene/keys", "mesh/model"}},
    {"case/directions", {"core", "scene", "scene/keys", "case/data", "case/text"}},
    {"case/materials", {"core", "scene", "scene/keys", "case/data", "case/text"}},
    {"case",
     {"core", "scene", "scene/keys", "mesh", "mesh/model", "case/data", "case/text", "case/directions", "case/materials"}},
    {"imaging", {"core", "math", "math/special", "scene"}},

    {"output/files", {"core", "scene"}},
    {"output/netcdf", {"core", "output/files"}},
    {"output/tables", {"core", "scene", "output/files", "output/netcdf"}},
    {"output/compare", {"core", "scene", "output/files", "output/netcdf", "output/tables"}},
    {"output/products", {"core", "scene", "imaging", "output/files", "output/netcdf", "output/tables"}},
    {"output/vtk", {"core", "scene", "imaging", "output/files", "output/tables"}},
    {"output/words", {"core", "scene", "output/tables"}},
    {"output/picture", {"core", "scene", "output/files", "output/tables"}},
    {"jobs/warnings", base + std::set<std::string>{"case/data", "case/materials", "mesh/soundness", "output/words", "plan",
                                                   "solve", "solve/mechanisms"}},
    {"jobs", base + std::set<std::string>{"jobs/warnings", "ranks", "case", "case/data", "case/materials", "imaging", "mesh",
                                          "output/files", "output/products", "output/tables", "output/words", "plan", "sbr",
                                          "sbr/launch", "solve", "solve/mechanisms"}},
    {"ranks", {"core"}},
    {"mpi", {"core", "ranks"}},
    {"program/work", {"core", "plan", "output/files", "output/netcdf", "solve"}},
    {"program", base + std::set<std::string>{"jobs",           "jobs/warnings",    "case",           "case/data",
                                             "case/materials", "case/text",        "mesh",           "output/compare",
                                             "output/files",   "output/netcdf",    "output/picture", "output/words",
                                             "output/tables",  "output/vtk",       "plan",           "sbr",
                                             "solve",          "solve/mechanisms", "utd/shadow",     "utd/wedge",
                                             "program/work",   "imaging",          "ranks",          "output/products"}},
    {"program/run",
     base + std::set<std::string>{"case", "case/data", "case/materials", "jobs", "jobs/warnings", "mesh", "output/compare",
                                  "output/files", "output/netcdf", "output/picture", "output/tables", "output/words", "plan",
                                  "program", "program/work", "ranks", "solve"}},

    {"point_source",
     {"core", "math", "math/special", "mesh", "mesh/model", "mesh/trace", "case/text", "output/files", "jobs", "program",
      "program/work"}},
};

struct SourceFile {
  std::string path;  // from the root
  std::vector<std::string> lines;

  std::string room() const { return fs::path(path).parent_path().string(); }
  std::string unit() const { return fs::path(path).replace_extension().string(); }
  bool is_header() const { return path.ends_with(".h"); }

  /// Those of this tree, as they are written.
  std::vector<std::string> includes() const {
    static const std::regex include(R"re(^\s*#include\s+"([^"]+)")re");
    std::vector<std::string> found;
    for (const std::string& line : lines)
      if (std::smatch match; line.find("#include") != std::string::npos && std::regex_search(line, match, include))
        found.push_back(match[1]);
    return found;
  }
};

/// In alphabetical order.
std::vector<SourceFile> read_tree(const fs::path& root) {
  std::vector<SourceFile> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    SourceFile& file = files.emplace_back(fs::relative(entry.path(), root).string());
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) file.lines.push_back(line);
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

const std::vector<SourceFile>& whole_source() {
  static const std::vector<SourceFile> files = read_tree(source);
  return files;
}

Findings arrows_back(const std::vector<SourceFile>& files, const Rooms& rooms) {
  Findings found;
  for (const SourceFile& file : files) {
    const auto room = rooms.find(file.room());
    if (room == rooms.end()) found.push_back(file.path + " lies in a room that has no rule");
    if (room == rooms.end()) continue;
    for (const std::string& include : file.includes()) {
      const std::string other = fs::path(include).parent_path().string();
      if (other != file.room() && !room->second.contains(other)) found.push_back(file.path + " includes " + include);
    }
  }
  return found;
}

/// Depth first: an include that leads to a unit still on the way closes a circle.
class CircleSearch {
 public:
  explicit CircleSearch(const std::vector<SourceFile>& files) {
    for (const SourceFile& file : files)
      for (const std::string& include : file.includes())
        if (const std::string other = fs::path(include).replace_extension().string(); other != file.unit())
          leads_to_[file.unit()].insert(other);
  }

  Findings run() {
    for (const auto& [unit, others] : leads_to_) visit(unit);
    return found_;
  }

 private:
  void visit(const std::string& unit) {
    if (const auto begin = std::ranges::find(way_, unit); begin != way_.end()) {
      std::string circle;
      for (auto at = begin; at != way_.end(); ++at) circle += *at + " -> ";
      found_.push_back(circle + unit);
      return;
    }
    if (done_.contains(unit)) return;
    way_.push_back(unit);
    if (const auto others = leads_to_.find(unit); others != leads_to_.end())
      for (const std::string& other : others->second) visit(other);
    way_.pop_back();
    done_.insert(unit);
  }

  std::map<std::string, std::set<std::string>> leads_to_;
  std::vector<std::string> way_;
  std::set<std::string> done_;
  Findings found_;
};

Findings full_rooms(const std::vector<SourceFile>& files) {
  std::map<std::string, int> count;
  for (const SourceFile& file : files) ++count[file.room()];
  Findings found;
  for (const auto& [room, number] : count)
    if (number > most_files) found.push_back(room + " holds " + std::to_string(number) + " files");
  return found;
}

/// Two types of one name that never meet in a source file get past the compiler, and the linker mixes up their functions.
Findings types_defined_twice(const std::vector<SourceFile>& files) {
  static const std::regex definition(R"(^(?:struct|class|enum class) (?:alignas\(\d+\) )?(\w+)(?: final)?(?: :.*)? \{)");
  std::map<std::string, std::string> defined_in;
  Findings found;
  for (const SourceFile& file : files) {
    if (!file.is_header()) continue;
    for (const std::string& line : file.lines) {
      std::smatch match;
      if (!std::regex_search(line, match, definition)) continue;
      const auto& [first, is_new] = defined_in.emplace(match[1], file.path);
      if (!is_new) found.push_back(first->first + ": " + first->second + " and " + file.path);
    }
  }
  return found;
}

/// What two versions of a library have in common; not installed.
const std::string two_versions = "mesh/trace/embree.h";

Findings foreign_libraries_in_headers(const std::vector<SourceFile>& files) {
  static const std::regex foreign(
      R"(#include\s+<(mpi\.h|embree|CGAL|OpenMesh|CLI|toml|nlohmann/json\.hpp|openssl|netcdf|OpenEXR))");
  Findings found;
  for (const SourceFile& file : files)
    if (file.is_header() && file.path != two_versions)
      for (const std::string& line : file.lines)
        if (std::regex_search(line, foreign)) found.push_back(file.path + ": " + line);
  return found;
}

TEST(Rooms, TheTreeIsRead) {
  const std::vector<SourceFile>& files = whole_source();
  EXPECT_GT(files.size(), 200u);
  std::set<std::string> rooms;
  for (const SourceFile& file : files) rooms.insert(file.room());
  for (const auto& [room, others] : may_include) EXPECT_TRUE(rooms.contains(room)) << room << " is empty";
}

TEST(Rooms, NoArrowAgainstTheOrder) { EXPECT_THAT(arrows_back(whole_source(), may_include), IsEmpty()); }

TEST(Rooms, NoCircleBetweenUnits) { EXPECT_THAT(CircleSearch(whole_source()).run(), IsEmpty()); }

TEST(Rooms, NoneIsOverfull) {
  EXPECT_THAT(full_rooms(whole_source()), IsEmpty());
  EXPECT_THAT(full_rooms(read_tree(fs::path(RAYTUBE_SOURCE_DIR) / "tests")), IsEmpty());
}

TEST(Rooms, TypesInHeadersHaveOneDefinition) { EXPECT_THAT(types_defined_twice(whole_source()), IsEmpty()); }

TEST(Rooms, ForeignLibrariesStayOutOfHeaders) { EXPECT_THAT(foreign_libraries_in_headers(whole_source()), IsEmpty()); }

/// A small tree for the checks themselves.
struct MadeUpTree {
  Scratch scratch;

  void write(const std::string& path, const std::string& text) const {
    fs::create_directories((scratch / path).parent_path());
    scratch.write(path, text);
  }
  std::vector<SourceFile> read() const { return read_tree(scratch.folder()); }
};

const Rooms two_floors = {{"low", {}}, {"high", {"low"}}};

TEST(RoomsCheck, AnArrowAgainstTheOrderIsFound) {
  const MadeUpTree tree;
  tree.write("low/a.h", "#pragma once\n");
  tree.write("high/b.h", "#include <vector>\n#include \"low/a.h\"\n");
  EXPECT_THAT(arrows_back(tree.read(), two_floors), IsEmpty());
  tree.write("low/c.cpp", "#include \"low/a.h\"\n#include \"high/b.h\"\n");
  EXPECT_THAT(arrows_back(tree.read(), two_floors), ElementsAre("low/c.cpp includes high/b.h"));
}

TEST(RoomsCheck, ARoomWithoutARuleIsFound) {
  const MadeUpTree tree;
  tree.write("low/inner/a.h", "");
  EXPECT_THAT(arrows_back(tree.read(), two_floors), ElementsAre("low/inner/a.h lies in a room that has no rule"));
}

// The source file of one unit includes the other one's header, and the other way round: no header does.
TEST(RoomsCheck, ACircleIsFound) {
  const MadeUpTree tree;
  for (const std::string unit : {"low/a", "low/b", "low/c"}) tree.write(unit + ".h", "");
  tree.write("low/a.cpp", "#include \"low/a.h\"\n#include \"low/b.h\"\n");
  tree.write("low/b.cpp", "#include \"low/b.h\"\n#include \"low/c.h\"\n");
  EXPECT_THAT(CircleSearch(tree.read()).run(), IsEmpty());
  tree.write("low/c.cpp", "#include \"low/a.h\"\n");
  EXPECT_THAT(CircleSearch(tree.read()).run(), ElementsAre("low/a -> low/b -> low/c -> low/a"));
}

TEST(RoomsCheck, AnOverfullRoomIsFound) {
  const MadeUpTree tree;
  for (int i = 0; i < most_files; ++i) tree.write("low/file_" + std::to_string(i) + (i % 2 ? ".h" : ".cpp"), "");
  tree.write("low/inner/one.h", "");
  tree.write("low/notes.txt", "");
  EXPECT_THAT(full_rooms(tree.read()), IsEmpty());
  tree.write("low/one_more.h", "");
  EXPECT_THAT(full_rooms(tree.read()), ElementsAre("low holds 31 files"));
}

TEST(RoomsCheck, ATypeDefinedTwiceIsFound) {
  const MadeUpTree tree;
  tree.write("low/a.h", "struct Piece {\n};\nstruct Other;\n");
  tree.write("high/b.h", "class Other final : public Piece {\n};\n");
  tree.write("high/b.cpp", "struct Piece {\n};\n");
  EXPECT_THAT(types_defined_twice(tree.read()), IsEmpty());
  tree.write("low/c.h", "struct alignas(32) Piece {\n");
  EXPECT_THAT(types_defined_twice(tree.read()), ElementsAre("Piece: low/a.h and low/c.h"));
}

TEST(RoomsCheck, AForeignLibraryInAHeaderIsFound) {
  const MadeUpTree tree;
  tree.write("low/a.cpp", "#include <embree3/rtcore.h>\n");
  EXPECT_THAT(foreign_libraries_in_headers(tree.read()), IsEmpty());
  tree.write("low/a.h", "#include <embree3/rtcore.h>\n");
  EXPECT_THAT(foreign_libraries_in_headers(tree.read()), ElementsAre("low/a.h: #include <embree3/rtcore.h>"));
}

}  // namespace
