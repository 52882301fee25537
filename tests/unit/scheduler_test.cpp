// Mechanisms run where they can move a row by the tolerance and their budget reaches far enough.
#include "solve/scheduler.h"

#include <gmock/gmock.h>

#include "scene/frequency_bands.h"

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
  const std::vector<double> frequencies{10e9};
  const Scheduler scheduler(frequencies, tolerance_db);
  const double counts = amplitude_of(tolerance_db);
  EXPECT_TRUE(scheduler.decide({.amplitude = {1.01 * counts}}, tubes(1)).any());
  const Decision not_run = scheduler.decide({.amplitude = {0.99 * counts}}, tubes(1));
  EXPECT_FALSE(not_run.any());
  EXPECT_NEAR(not_run.most_db, 20.0 * std::log10(1.0 + 0.99 * counts), 1e-12);
  EXPECT_TRUE(scheduler.decide({.amplitude = {0.99 * counts}}, tubes(1, 0.5)).any());
  EXPECT_FALSE(scheduler.decide({.amplitude = {1.4 * counts}, .tolerances = 1.5}, tubes(1)).any());
  EXPECT_TRUE(scheduler.decide({.amplitude = {1.6 * counts}, .tolerances = 1.5}, tubes(1)).any());
}

TEST(Scheduler, RunsWhatHasNoEstimate) {
  const std::vector<double> frequencies{1e9, 2e9};
  EXPECT_THAT(Scheduler(frequencies, tolerance_db).decide({}, tubes(2)).wanted, Each(true));
}

TEST(Scheduler, DoesNotBeginWhatReachesLessThanHalf) {
  const std::vector<double> frequencies{1e9};
  const Scheduler scheduler(frequencies, tolerance_db);
  EXPECT_FALSE(scheduler.decide({.reach = 0.49}, tubes(1)).any());
  EXPECT_TRUE(scheduler.decide({.reach = 0.5}, tubes(1)).any());
}

// A null of one frequency does not decide for its band; another band has no say.
TEST(Scheduler, DecidesBandByBand) {
  const std::vector<double> frequencies{9.5e9, 9.7e9, 3e9};
  ASSERT_EQ(band_of(frequencies[0]), band_of(frequencies[1]));
  TubeSums sums = tubes(3);
  sums.bounces[0][1] *= 1e-6;
  const Scheduler scheduler(frequencies, tolerance_db);
  const double counts = amplitude_of(tolerance_db);
  const double of_mean = counts * std::sqrt(0.5);
  EXPECT_THAT(scheduler.decide({.amplitude = {0.99 * of_mean, 0.99 * of_mean, 2.0 * counts}}, sums).wanted,
              ElementsAre(false, false, true));
  EXPECT_THAT(scheduler.decide({.amplitude = {1.01 * of_mean, 1.01 * of_mean, 0.5 * counts}}, sums).wanted,
              ElementsAre(true, true, false));
}

// Without anything to be compared with, what may add anything runs.
TEST(Scheduler, RunsBesideNothing) {
  const std::vector<double> frequencies{1e9};
  const Scheduler scheduler(frequencies, tolerance_db);
  EXPECT_TRUE(scheduler.decide({.amplitude = {1e-9}}, tubes(1, 0.0)).any());
  EXPECT_FALSE(scheduler.decide({.amplitude = {0.0}}, tubes(1, 0.0)).any());
}

}  // namespace
}  // namespace raytube
