// raytube check --wedges, from the program itself.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

/// The list that `raytube check` writes for a case.
testing::Table wedge_list(const testing::Scratch& scratch, const std::string& case_file, const std::string& more = "") {
  const std::string file = (scratch / "wedges.csv").string();
  const std::string command = std::string(RAYTUBE_PROGRAM) + " check " + case_file + " --wedges " + file + more + " > /dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
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
