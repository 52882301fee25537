// The plain picture of a run.
#include <gmock/gmock.h>

#include "output/picture/gnuplot.h"
#include "output/picture/rcs_picture.h"
#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

// A sweep over azimuths, and polar angles if there are several, whose VV grows with the number of the row.
struct Swept {
  Sweep sweep{{1e9}, {}, false};
  SweepResult result;

  Swept(int azimuths, int polar_angles) {
    for (int i = 0; i < polar_angles; ++i)
      for (int j = 0; j < azimuths; ++j) {
        const Direction direction{(60.0 + i) * degree, j * degree};
        sweep.looks.push_back({direction, direction});
        result.total.push_back({{{{Complex(1.0 + i * azimuths + j), Complex(0.0)}, {Complex(0.0), Complex(1.0)}}}});
      }
  }
};

void expect_pictures(const Swept& swept) {
  const Scratch scratch;
  if (const std::string trouble = draw_rcs(scratch.folder(), "it's \"a\" title", swept.sweep, swept.result, {}); !trouble.empty())
    GTEST_SKIP() << trouble;
  EXPECT_EQ(text_of(scratch / "rcs.png").substr(1, 3), "PNG");
  EXPECT_THAT(text_of(scratch / "rcs.svg"), HasSubstr("it's"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "rcs.png.gnuplot"));
}

TEST(RcsPicture, OneQuantityMakesCurves) { expect_pictures(Swept(9, 1)); }

TEST(RcsPicture, FewValuesOfASecondQuantityMakePanels) { expect_pictures(Swept(9, 3)); }

TEST(RcsPicture, TwoQuantitiesMakeMaps) { expect_pictures(Swept(9, 7)); }

TEST(RcsPicture, ASingleRowAndOneWithoutAnyReturnAreDrawnToo) {
  expect_pictures(Swept(1, 1));
  Swept nothing(9, 7);
  for (ScatteringMatrix& s : nothing.result.total) s = {};
  expect_pictures(nothing);
}

TEST(RcsPicture, WhatIsNoCommandOfGnuplotLeavesNothing) {
  const Scratch scratch;
  EXPECT_NE(draw_picture(scratch / "x.png", "100,100", "plot nonsense("), "");
  EXPECT_TRUE(std::filesystem::is_empty(scratch.folder()));
}

}  // namespace
}  // namespace raytube
