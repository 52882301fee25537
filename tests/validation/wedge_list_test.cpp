// raytube check --wedges, from the program itself.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

TEST(WedgeList, NamesTheTwelveEdgesOfTheCube) {
  const testing::Scratch scratch;
  const std::string file = (scratch / "wedges.csv").string();
  const std::string command =
      std::string(RAYTUBE_PROGRAM) + " check " RAYTUBE_SOURCE_DIR "/cases/powercube/case.toml --wedges " + file + " > /dev/null";
  ASSERT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
  const testing::Table table(file);
  ASSERT_EQ(table.rows(), 12u);
  int lit = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(table.number(i, "length_m"), 0.09, 1e-12);
    EXPECT_NEAR(table.number(i, "n"), 1.5, 1e-12);
    lit += table.number(i, "lit_fraction") > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(lit, 11);  // the first look sees two faces and grazes top and bottom: only the upright edge behind is hidden
}

}  // namespace
}  // namespace raytube
