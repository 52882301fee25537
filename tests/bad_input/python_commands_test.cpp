// Commands that the Python package does: what the program hands over, and what it says where the package is missing.
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class PythonCommands : public BadInput {
 protected:
  void stand_in_for_python(const std::string& script) {
    fs::permissions(scratch.write("python", "#!/bin/sh\n" + script + '\n'), fs::perms::owner_all);
  }
  static constexpr const char* from_here = "RAYTUBE_PYTHON=./python ";
};

// 93 is how the first lines that Python gets say that there is no such package.
TEST_F(PythonCommands, AMissingPackageIsOneSentence) {
  stand_in_for_python("exit 93");
  for (const char* words : {"plot rcs.csv", "statistics rcs.csv -o out", "report .", "compare a.exr b.exr -o out"}) {
    const Outcome outcome = raytube(words, from_here);
    EXPECT_EQ(outcome.code, 3) << words;
    EXPECT_THAT(outcome.complaint, AllOf(StartsWith("raytube: "), HasSubstr("needs the Python package raytube"))) << words;
    EXPECT_EQ(std::ranges::count(outcome.complaint, '\n'), 1) << words;
    EXPECT_FALSE(fs::exists(scratch / "out")) << words;
  }
}

TEST_F(PythonCommands, WordsAndExitCodesPassThrough) {
  stand_in_for_python("shift 2; printf '%s|' \"$@\" >words.txt; exit 1");
  EXPECT_EQ(raytube("plot 'a b.csv' --kind polar", from_here).code, 1);
  EXPECT_EQ(text_of(scratch / "words.txt"), "plot|a b.csv|--kind|polar|");
  EXPECT_EQ(raytube("help report", from_here).code, 1);
  EXPECT_EQ(text_of(scratch / "words.txt"), "report|--help|");
  scratch.write("image.csv", "row,col,re_vv,im_vv\n0,0,1,0\n");
  EXPECT_EQ(raytube("compare image.csv image.csv --tolerance-db 1", from_here).code, 1);
  EXPECT_EQ(text_of(scratch / "words.txt"), "compare|image.csv|image.csv|--tolerance-db|1|");
}

TEST_F(PythonCommands, ARunIsCompleteWithoutIt) {
  stand_in_for_python("exit 93");
  const Outcome outcome = raytube("run case.toml --parts --quiet", from_here);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint, HasSubstr("draws them later"));
  EXPECT_TRUE(fs::exists(scratch / "out/parts.csv"));
  EXPECT_FALSE(fs::exists(scratch / "out/parts.png"));
}

}  // namespace
}  // namespace raytube
