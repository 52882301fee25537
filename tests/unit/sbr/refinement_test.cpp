// Which blocks of a look are traced again.
#include <gtest/gtest.h>

#include <cmath>

#include "sbr/refinement.h"

namespace raytube {
namespace {

// Squares 0.01, 4, 0.04, 0.16: the second, third and fourth smallest stay below a quarter.
TEST(Refinement, LeavesAloneWhatHardlyCounts) {
  const Refinement r = refinement({{0.1, true}, {2.0, true}, {0.2, true}, {0.4, true}}, 2.05, 1.5);
  EXPECT_EQ(r.blocks, (std::vector<std::size_t>{1}));
  EXPECT_GT(r.growth, 1.5);
  EXPECT_LT(r.growth, 4.0);
}

// Errors that fall with the power of their order come to what is aimed at, two thirds of what may be left.
TEST(Refinement, ReachesWhatIsPermitted) {
  for (const double order : {1.0, 1.5}) {
    const Refinement r = refinement({{1.0, true}, {0.5, true}}, std::sqrt(1.25), order);
    EXPECT_LT(std::pow(r.growth, -order) * 1.0, std::sqrt(1.0 - 0.25));
  }
}

// A hundred alike errors of 0.04 are 0.4 as squares, which nothing would be done about, and 4 as amplitudes.
TEST(Refinement, SeesErrorsThatAddUp) {
  const std::vector<BlockError> errors(100, {0.04, true});
  EXPECT_TRUE(refinement(errors, 0.4, 1.5).blocks.empty());
  EXPECT_GE(refinement(errors, 4.0, 1.5).blocks.size(), 90u);
}

TEST(Refinement, TakesNoBlockThatCannotBeBetter) {
  EXPECT_TRUE(refinement({{3.0, false}, {0.0, true}}, 3.0, 1.5).blocks.empty());
  EXPECT_EQ(refinement({{3.0, false}, {1.0, true}}, 3.2, 1.5).blocks, (std::vector<std::size_t>{1}));
}

}  // namespace
}  // namespace raytube
