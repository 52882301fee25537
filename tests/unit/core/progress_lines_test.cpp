// Lines about progress, by a clock of the test's own.
#include "core/progress_lines.h"

#include <gmock/gmock.h>

#include "core/time_left.h"

namespace raytube {
namespace {

using ::testing::Optional;

TEST(ProgressLines, AShortRunHasNone) {
  ProgressLines lines;
  for (int i = 1; i <= 100; ++i) EXPECT_FALSE(lines.due(0.01 * i, 0.2999 * i, 1.0)) << i;
}

// Ten per cent in 10 s each: every third of them is 30 s after the last line.
TEST(ProgressLines, NoSoonerThanHalfAMinuteAfterTheLast) {
  ProgressLines lines;
  std::vector<std::string> said;
  for (int second = 1; second <= 100; ++second)
    if (const auto line = lines.due(0.01 * second, second, 100.0 - second)) said.push_back(*line);
  EXPECT_THAT(said, ::testing::ElementsAre("30 % after 30 s, about 1 min 10 s left", "60 % after 1 min 00 s, about 40 s left",
                                           "90 % after 1 min 30 s, about 10 s left"));
}

TEST(ProgressLines, NoSoonerThanTenPerCentMore) {
  ProgressLines lines;
  EXPECT_FALSE(lines.due(0.0999, 3000.0, 1.0));
  EXPECT_THAT(lines.due(0.1, 3600.0, 32400.0), Optional(std::string("10 % after 1 h 00 min, about 9 h 00 min left")));
  EXPECT_FALSE(lines.due(0.1999, 7000.0, 1.0));
  EXPECT_TRUE(lines.due(0.2, 7200.0, 1.0));
  EXPECT_FALSE(lines.due(1.0, 36000.0, 0.0));  // the end speaks for itself
}

TEST(TimeLeft, GoesOnAtTheRateSoFar) {
  TimeLeft left;
  EXPECT_FALSE(left.after(0.0, 5.0));  // until then all was preparation
  EXPECT_DOUBLE_EQ(left.after(0.25, 15.0).value(), 30.0);
  EXPECT_DOUBLE_EQ(left.after(1.0, 45.0).value(), 0.0);
}

TEST(TimeLeft, WhatWasThereShowsNoRate) {
  TimeLeft left(0.6);
  EXPECT_FALSE(left.after(0.3, 1.0));
  EXPECT_FALSE(left.after(0.2 + 0.4, 2.0));
  EXPECT_DOUBLE_EQ(left.after(0.7, 12.0).value(), 30.0);
}

TEST(TimeLeft, WhereAllWasThereNothingIsLeftToBeSaid) { EXPECT_FALSE(TimeLeft(1.0).after(1.0, 3.0)); }

TEST(ProgressLines, Durations) {
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(3599.6), "1 h 00 min");
  EXPECT_EQ(duration_text(7620.0), "2 h 07 min");
}

}  // namespace
}  // namespace raytube
