// The time of a solve, told beforehand.
#include "solve/probe.h"

#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "solve/solve.h"

namespace raytube {
namespace {

Sweep eight_looks() {
  Sweep sweep{{10e9}, {}};
  for (int i = 0; i < 8; ++i) sweep.looks.push_back({{0.5 + 0.1 * i, 0.3}, {0.5 + 0.1 * i, 0.3}});
  return sweep;
}

SolvePlan plan_with_budget(const Target& target, const Sweep& sweep, double budget) {
  SolveOptions options;
  options.edges.interaction_budget = budget;
  options.threads = 1;
  options.surfaces.waves = true;  // a look takes longer than the patience of the last test
  return {target, sweep, options};
}

const Target& two_faces() {
  static const Target target(build_mesh(shapes::dihedral(0.2, 0.2), 1.0).mesh, {});
  return target;
}

// Tubes whose first half took 1 s take 2 s, with less dense ones before 1 / (1 - 1 / 1.5^2) = 1.8 times that; edges that were
// not done thirty times what had passed of them, or a pass of the tubes; the budget is 4 times all of it.
TEST(Probe, TheLongestThatALookMayTake) {
  const Sweep sweep = eight_looks();
  const SolvePlan plan = plan_with_budget(two_faces(), sweep, 4.0);
  EXPECT_NEAR(longest_look({.share = 0.5, .share_s = 1.0, .passed_s = 1.0}, plan), 5.0 * (1.8 * 2.0 + 60.0), 1e-9);
  EXPECT_NEAR(longest_look({1.0, 2.0, 2.0, {}, 3.0}, plan), 5.0 * (1.8 * 2.0 + 30.0), 1e-9);
  EXPECT_NEAR(longest_look({1.0, 2.0, 2.0, 2.5, 2.5}, plan), 5.0 * (1.8 * 2.0 + 0.5), 1e-9);
  EXPECT_NEAR(longest_look({.passed_s = 1.0}, plan), 5.0 * (1.8 * 100.0 + 30.0 * 100.0), 1e-9);
}

// Where no look is done in time there is a bound below and one above.
TEST(Probe, BoundsHoldWhereNoLookIsDoneInTime) {
  const Target target(build_mesh(shapes::icosphere(4, 0.3), 1.0).mesh, {});
  const Sweep sweep = eight_looks();
  const SolvePlan plan = plan_with_budget(target, sweep, 4.0);
  const TimePrediction time = predict_time(plan, 0.0, 3e-3);
  ASSERT_TRUE(time.at_most);
  EXPECT_GE(time.solve_s, time.least_s);  // equal where no look has begun in time, on a busy machine
  EXPECT_GT(time.least_s, 0.0);
}

}  // namespace
}  // namespace raytube
