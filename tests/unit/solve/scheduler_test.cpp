// Mechanisms run where they can move a row by the tolerance and their budget reaches far enough.
#include "solve/scheduler.h"

#include <gmock/gmock.h>

namespace raytube {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

constexpr double tolerance_db = 0.1;

// Of unit amplitude at every frequency, but for the weaker channel.
TubeSums tubes(std::size_t frequencies, double weaker = 1.0) {
  TubeSums sums;
  ScatteringMatrix s;
  s.at(0, 0) = 1.0, s.at(1, 1) = weaker;
  sums.at(0, frequencies).assign(frequencies, s);
  return sums;
}

double amplitude_of(double decibels) { return std::pow(10.0, decibels / 20.0) - 1.0; }

TEST(Scheduler, RunsWhatMovesTheWeakerChannelByTheTolerance) {
  const double counts = amplitude_of(tolerance_db);
  EXPECT_TRUE(decide({.amplitude = {1.01 * counts}}, tubes(1), 1, tolerance_db).any());
  const Decision not_run = decide({.amplitude = {0.99 * counts}}, tubes(1), 1, tolerance_db);
  EXPECT_FALSE(not_run.any());
  EXPECT_NEAR(not_run.most_db, 20.0 * std::log10(1.0 + 0.99 * counts), 1e-12);
  EXPECT_TRUE(decide({.amplitude = {0.99 * counts}}, tubes(1, 0.5), 1, tolerance_db).any());
  EXPECT_FALSE(decide({.amplitude = {1.4 * counts}, .tolerances = 1.5}, tubes(1), 1, tolerance_db).any());
  EXPECT_TRUE(decide({.amplitude = {1.6 * counts}, .tolerances = 1.5}, tubes(1), 1, tolerance_db).any());
}

TEST(Scheduler, RunsWhatHasNoEstimate) { EXPECT_THAT(decide({}, tubes(2), 2, tolerance_db).wanted, Each(true)); }

TEST(Scheduler, DoesNotBeginWhatReachesLessThanHalf) {
  EXPECT_FALSE(decide({.reach = 0.49}, tubes(1), 1, tolerance_db).any());
  EXPECT_TRUE(decide({.reach = 0.5}, tubes(1), 1, tolerance_db).any());
}

// A null of one frequency decides for itself alone.
TEST(Scheduler, DecidesRowByRow) {
  TubeSums sums = tubes(3);
  sums.bounces[0][1] *= 1e-6;
  const double counts = amplitude_of(tolerance_db);
  EXPECT_THAT(decide({.amplitude = {0.99 * counts, 0.99 * counts, 1.01 * counts}}, sums, 3, tolerance_db).wanted,
              ElementsAre(false, true, true));
}

// Without anything to be compared with, what may add anything runs.
TEST(Scheduler, RunsBesideNothing) {
  EXPECT_TRUE(decide({.amplitude = {1e-9}}, tubes(1, 0.0), 1, tolerance_db).any());
  EXPECT_FALSE(decide({.amplitude = {0.0}}, tubes(1, 0.0), 1, tolerance_db).any());
}

}  // namespace
}  // namespace raytube
