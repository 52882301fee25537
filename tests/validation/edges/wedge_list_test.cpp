// raytube check --wedges, from the program itself.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "run.h"
#include "scratch.h"
#include "vtk_file.h"

namespace raytube {
namespace {

void write_list(const std::string& file, const std::string& case_file, const std::string& more) {
  const std::string command = std::string(RAYTUBE_PROGRAM) + " check " + case_file + " --wedges " + file + more + " > /dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
}

/// The list that `raytube check` writes for a case.
testing::Table wedge_list(const testing::Scratch& scratch, const std::string& case_file, const std::string& more = "") {
  const std::string file = (scratch / "wedges.csv").string();
  write_list(file, case_file, more);
  return testing::Table(file);
}

TEST(WedgeList, NamesTheTwelveEdgesOfTheCube) {
  const testing::Scratch scratch;
  const testing::Table table = wedge_list(scratch, RAYTUBE_SOURCE_DIR "/cases/powercube/case.toml");
  ASSERT_EQ(table.rows(), 12u);
  int lit = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(table.number(i, "length_m"), 0.09, 1e-12);
    EXPECT_NEAR(table.number(i, "n"), 1.5, 1e-12);
    lit += table.number(i, "lit_fraction") > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(lit, 11);  // the first look sees two faces and grazes top and bottom: only the upright edge behind is hidden
}

// Numbers are written shortest-round-trip in both, positions of lines to nine digits: 1e-10 of 0.1 m is more than half a unit.
TEST(WedgeList, IsTheSameAsLines) {
  const testing::Scratch scratch;
  const std::string cube = RAYTUBE_SOURCE_DIR "/cases/powercube/case.toml", file = (scratch / "wedges.vtp").string();
  const testing::Table table = wedge_list(scratch, cube);
  for (int time = 0; time < 2; ++time) write_list(file, cube, "");  // over its own earlier file, too
  const std::string text = testing::text_of(file);
  for (const char* name :
       {"wedge", "length_m", "interior_deg", "n", "face1_patch", "face2_patch", "lit_fraction", "thickness_m"}) {
    const std::vector<double> lines = testing::vtk_numbers(text, name);
    ASSERT_EQ(lines.size(), table.rows()) << name;
    for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i], table.number(i, name)) << name;
  }
  const std::vector<double> points = testing::vtk_numbers(text, "points"), ends = testing::vtk_numbers(text, "offsets");
  ASSERT_EQ(points.size(), 6 * table.rows());
  ASSERT_EQ(ends.size(), table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    EXPECT_EQ(ends[i], 2.0 * static_cast<double>(i + 1));
    EXPECT_NEAR(points[6 * i], table.number(i, "x1_m"), 1e-10);
    EXPECT_NEAR(points[6 * i + 5], table.number(i, "z2_m"), 1e-10);
  }
}

TEST(WedgeList, NamesTheHalfPlanesOfAThinPlateAtTheHighestFrequency) {
  const testing::Scratch scratch;
  std::ofstream(scratch / "plate.obj")
      << "v 0 0 0\nv 300 0 0\nv 300 200 0\nv 0 200 0\nv 0 0 2\nv 300 0 2\nv 300 200 2\nv 0 200 2\n"
         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const std::string case_file = (scratch / "case.toml").string();
  std::ofstream(case_file) << "[target]\nmesh = \"plate.obj\"\nunit = \"mm\"\n[frequency]\nghz = [3, 10]\n"
                              "[look]\ntheta_deg = 50\nphi_deg = 20\n";
  const testing::Table thin = wedge_list(scratch, case_file);
  ASSERT_EQ(thin.rows(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(thin.number(i, "n"), 2.0, 1e-12);
    EXPECT_NEAR(thin.number(i, "thickness_m"), 0.002, 1e-12);
    EXPECT_NEAR(thin.number(i, "z1_m"), 0.001, 1e-12);
    EXPECT_EQ(thin.number(i, "lit_fraction"), 1.0);
  }
  EXPECT_EQ(wedge_list(scratch, case_file, " --set edges.thin_sheets=false").rows(), 12u);
  EXPECT_EQ(wedge_list(scratch, case_file, " --set frequency.ghz=[3,20]").rows(), 12u);  // 2 mm are more than a tenth of 15 mm
}

}  // namespace
}  // namespace raytube
