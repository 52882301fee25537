// raytube sources through the real program: what is written, what an interrupt leaves, what bad input is told.
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

class SourcesProgram : public BadInput {
 protected:
  void SetUp() override {
    scratch.write("mesh.off", plate);
    scratch.write("case.toml",
                  "[scene]\nbox_m = [[-2, -2, -2], [2, 2, 2]]\n"
                  "[[scene.parts]]\nname = \"plate\"\nmesh = \"mesh.off\"\nunit = \"m\"\nsurface = \"pec\"\n"
                  "[source]\npoint_m = [0.5, 0.5, 1]\nrays = [100, 1000]\ncounted = \"plate\"\n");
  }
};

TEST_F(SourcesProgram, WritesTablePicturesAndPoints) {
  EXPECT_EQ(raytube("sources case.toml --threads 1").code, 0);
  for (const char* name :
       {"launch.png", "launch.svg", "hits.png", "hits.svg", "sources.png", "sources.svg", "hits.ply", "launch.ply", "sources.csv"})
    EXPECT_TRUE(fs::exists(scratch / "out" / name)) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "out"), {}), 10);  // with their list
  const std::string table = text_of(scratch / "out/sources.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 6 + 1 + 12);  // meanings, header, six models of two counts
  EXPECT_THAT(table, HasSubstr("\n0,0.5,0.5,1,octahedron,1000,512,plate,"));
  EXPECT_THAT(text_of(scratch / "out/hits.ply"), HasSubstr("element vertex "));
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("hits on plate"));
}

TEST_F(SourcesProgram, SeveralPositionsMakeOneTableAndAResponse) {
  EXPECT_EQ(
      raytube("sources case.toml --quiet --set 'source.point_m=[[0.5,0.5,1],[0.5,0.5,1.5]]' --set source.models=geometry").code,
      0);
  const std::string table = text_of(scratch / "out/sources.csv");
  EXPECT_THAT(table, HasSubstr("\n1,0.5,0.5,1.5,geometry,1000,"));
  EXPECT_TRUE(fs::exists(scratch / "out/sources.png"));
  EXPECT_EQ(text_of(scratch / "stdout.txt"), "");
}

TEST_F(SourcesProgram, AnInterruptLeavesNothing) {
  const Outcome outcome =
      raytube("sources case.toml --quiet --set source.rays=20000000", "timeout --preserve-status -s INT -k 5 1 ");
  EXPECT_EQ(outcome.code, 130);
  EXPECT_EQ(outcome.complaint, "raytube: interrupted; no results written\n");
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

// Every ray at the plate makes a hit that is kept, and the sample knows.
TEST_F(SourcesProgram, MoreHitsThanThereIsMemoryForAreRefused) {
  if (!memory_can_be_limited) GTEST_SKIP() << "under a sanitizer";
  const Outcome outcome =
      raytube("sources case.toml --set source.rays=100000000 --set source.models=geometry", "ulimit -v 2000000; ");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint,
              AllOf(HasSubstr("case.toml: the hits of 100000000 rays on \"plate\" would take about 11.5 GB of memory"),
                    HasSubstr("; source.rays = "), HasSubstr(" would fit")));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST_F(SourcesProgram, BadInputIsRefused) {
  expect_refused("sources", "case is required");
  expect_refused("sources missing.toml", "missing.toml: no such file");
  expect_refused("sources case.toml --set source.ray=5", "unknown key \"source.ray\"; did you mean \"source.rays\"?");
  expect_refused("sources case.toml --set source.point_m=[0,0,2]",
                 "case.toml: source.point_m lies on the enclosing box or outside it");
  expect_refused("sources case.toml --set 'scene.box_m=[[0,0,0],[0.5,1,1]]'",
                 "scene.box_m does not enclose the parts of the scene");
  fs::remove(scratch / "mesh.off");
  expect_refused("sources case.toml", "mesh.off': not found");
}

}  // namespace
}  // namespace raytube
