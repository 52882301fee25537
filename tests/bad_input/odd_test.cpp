// What looks odd and is fine: bytes other systems put into text, and names that lead elsewhere.
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;

const std::string mark = "\xEF\xBB\xBF";
const std::string no_plots = " --set output.plots=false";

std::string with_crlf(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

class OddInput : public BadInput {
 protected:
  void expect_same(const std::string& words, const std::string& before = "") {
    ASSERT_EQ(raytube("run case.toml -o usual" + no_plots).code, 0);
    const Outcome outcome = raytube(words + " -o odd" + no_plots, before);
    EXPECT_EQ(outcome.code, 0) << outcome.complaint;
    EXPECT_EQ(text_of(scratch / "odd/rcs.csv"), text_of(scratch / "usual/rcs.csv"));
  }
};

TEST_F(OddInput, CaseWithByteOrderMarkAndCrLf) {
  scratch.write("odd.toml", mark + with_crlf(good_case));
  expect_same("run odd.toml");
}

TEST_F(OddInput, MeshWithByteOrderMarkAndCrLf) {
  scratch.write("odd.off", mark + with_crlf(plate));
  expect_same("run case.toml --set target.mesh='\"odd.off\"'");
}

// Curves and surfaces of free form beside good facets, and the words that belong to them.
TEST_F(OddInput, MeshWithFreeFormsTellsThatTheyAreLeftOut) {
  const std::string facets = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
  scratch.write("odd.obj",
                facets + "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\ncurv 0 1 1 2\nend\n");
  const std::string mesh = " case.toml --set target.mesh='\"odd.obj\"'";
  expect_same("run" + mesh);
  EXPECT_THAT(text_of(scratch / "odd/run.json"), ::testing::HasSubstr("\"free_forms_read\": 2,"));
  EXPECT_EQ(raytube("check" + mesh).code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), ::testing::HasSubstr("free-form curves and surfaces were ignored"));
}

// Line ends and zeros that fill a block are not taken for facets.
TEST_F(OddInput, MeshWithBlanksAtTheEnd) {
  scratch.write("odd.off", plate + "\n# the end\n \n");
  expect_same("run case.toml --set target.mesh='\"odd.off\"'");
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  scratch.write("odd.ply", head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n\n \n");
  expect_same("run case.toml --set target.mesh='\"odd.ply\"'");
}

TEST_F(OddInput, LooksWithByteOrderMarkCrLfAndQuotes) {
  scratch.write("odd.csv", mark + "\"theta_deg\",\"phi_deg\"\r\n\"10\",\"0\"\r\n");
  expect_same("run case.toml --set 'look={looks_csv=\"odd.csv\"}'");
}

TEST_F(OddInput, MeshOutsideTheCasesFolderAndThroughLinks) {
  fs::create_directories(scratch / "deep/cases");
  fs::create_symlink("../../mesh.off", scratch / "deep/cases/link.off");
  scratch.write("deep/cases/case.toml", good_case);
  expect_same("run deep/cases/case.toml --set target.mesh='\"../../mesh.off\"'");
  expect_same("run deep/cases/case.toml --set target.mesh='\"link.off\"'");
}

TEST_F(OddInput, NamesThatAreNoTextInUtf8) {
  expect_same("run ./odd$(printf '\\377').toml", "cp case.toml odd$(printf '\\377').toml && ");
}

// Results go where -o says, through a link to a folder too, under names of our own whatever the case is called.
TEST_F(OddInput, NothingIsWrittenOutsideTheOutputFolder) {
  fs::create_directory(scratch / "elsewhere");
  fs::create_symlink("elsewhere", scratch / "link");
  const std::string title = " --set 'title=\"../../`touch broken` $(touch broken) \\\"x\\\" '\"'\"'y\"'";
  EXPECT_EQ(raytube("run case.toml -o link" + title).code, 0);
  EXPECT_TRUE(fs::exists(scratch / "elsewhere/rcs.csv"));
  EXPECT_TRUE(fs::exists(scratch / "elsewhere/rcs.png"));
  EXPECT_FALSE(fs::exists(scratch / "broken"));
  EXPECT_FALSE(fs::exists(scratch / "elsewhere/broken"));
}

}  // namespace
}  // namespace raytube
