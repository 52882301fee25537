// raytube converge through the real program: what is written, what an interrupt leaves, what bad input is told.
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

class ConvergeProgram : public BadInput {};

TEST_F(ConvergeProgram, WritesTableAndPictureBesideTheCase) {
  EXPECT_EQ(raytube("converge case.toml --set target.unit=m --set frequency.ghz=1 --densities 8,2,4 --threads 1").code, 0);
  const std::string text = text_of(scratch / "out/converge.csv");
  EXPECT_THAT(text, HasSubstr("\n2,"));
  EXPECT_LT(text.find("\n4,"), text.find("\n8,"));  // coarse ones first, whatever order they were given in
  EXPECT_TRUE(fs::exists(scratch / "out/converge.png"));
  EXPECT_TRUE(fs::exists(scratch / "out/converge.svg"));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "out"), {}), 4);  // with their list
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("recommendation"));
}

TEST_F(ConvergeProgram, WithoutPlotsNoneOfAnEarlierStudyIsLeft) {
  ASSERT_EQ(raytube("converge case.toml -o old --densities 1,2,4").code, 0);
  ASSERT_TRUE(fs::exists(scratch / "old/converge.png"));
  scratch.write("old/rcs.csv", "earlier");
  EXPECT_EQ(raytube("converge case.toml -o old --densities 1,2,3 --set output.plots=false").code, 0);
  EXPECT_FALSE(fs::exists(scratch / "old/converge.png"));
  EXPECT_EQ(text_of(scratch / "old/rcs.csv"), "earlier");
}

// The first density takes milliseconds, the second one hours.
TEST_F(ConvergeProgram, AnInterruptKeepsWhatIsFinished) {
  const std::string hours =
      "--set target.unit=m --set 'look.phi_deg={start=0,stop=90,step=0.05}' --set edges.method=none --densities 0.1,2000,2001 "
      "--quiet";
  const Outcome outcome = raytube("converge case.toml " + hours, "timeout --preserve-status -s INT -k 5 2 ");
  EXPECT_EQ(outcome.code, 130);
  EXPECT_EQ(outcome.complaint, "raytube: interrupted; converge.csv in out holds the 1 of 3 densities that were finished\n");
  EXPECT_THAT(text_of(scratch / "out/converge.csv"), HasSubstr("\n0.1,"));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "out"), {}), 2);  // with its list
}

TEST_F(ConvergeProgram, AnInterruptBeforeTheFirstIsFinishedLeavesNothing) {
  const std::string hours =
      "--set target.unit=m --set 'look.phi_deg={start=0,stop=90,step=0.05}' --densities 1000,2000,2001 --quiet";
  const Outcome outcome = raytube("converge case.toml " + hours, "timeout --preserve-status -s INT -k 5 1 ");
  EXPECT_EQ(outcome.code, 130);
  EXPECT_EQ(outcome.complaint, "raytube: interrupted; no results written\n");
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST_F(ConvergeProgram, BadInputIsRefused) {
  expect_refused("converge", "case is required");
  expect_refused("converge missing.toml", "missing.toml: no such file");
  expect_refused("converge case.toml --set target.mesh=missing.stl", "missing.stl");
  expect_refused("converge case.toml --densities 4,8", "--densities 4,8: at least three different densities");
  expect_refused("converge case.toml --densities 4,8,8", "at least three different densities");
  expect_refused("converge case.toml --densities 4,eight,16", "--densities 4,eight,16: write tubes per wavelength");
  expect_refused("converge case.toml --densities -4,8,16", "write tubes per wavelength");
  expect_refused("converge case.toml --densities 4,8,1e9",
                 "--densities 4,8,1e9: 1000000000 tubes per wavelength are more than 10^6");
  expect_refused("converge case.toml --set edges.method=utd", "has no tubes whose density could be studied");
  expect_refused("converge case.toml --threads 0", "--threads");
  expect_refused("converge case.toml --parts", "--parts");
  scratch.write("file", "");
  expect_refused("converge case.toml -o file", "choose another one with -o DIR");
}

}  // namespace
}  // namespace raytube
