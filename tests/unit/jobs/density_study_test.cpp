// Studies over the density of tubes: how much of their work is done.
#include "jobs/density_study.h"

#include <gtest/gtest.h>

#include <vector>

namespace raytube {
namespace {

TEST(DensityStudy, ItsWorkGrowsWithTheSquareOfTheDensity) {
  const std::vector<double> densities{1.0, 2.0, 4.0};  // 1, 4 and 16 of 21 parts
  EXPECT_DOUBLE_EQ(finished_share(densities, 0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(finished_share(densities, 0, 0.5), 0.5 / 21.0);
  EXPECT_DOUBLE_EQ(finished_share(densities, 2, 0.25), 9.0 / 21.0);
  EXPECT_DOUBLE_EQ(finished_share(densities, 3, 0.0), 1.0);
}

}  // namespace
}  // namespace raytube
