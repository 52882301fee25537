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
