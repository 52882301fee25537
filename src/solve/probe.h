// How long a solve will take, from a few of its looks.
#pragma once

#include <optional>

#include "plan/plan.h"

namespace raytube {

struct TimePrediction {
  double solve_s = 0.0;   // of the whole solve on its threads, as Statistics::solve_s [s]
  double look_s = 0.0;    // of one look on one thread, on average [s]
  std::size_t looks = 0;  // that were timed
  bool at_most = false;   // the first looks were not done in time: the solve and a look take no longer than this ...
  double least_s = 0.0;   // ... and the solve no less than this [s]
};

/// How far a look had come when it was done or given up, its tubes traced once, as dense as may be [s from its start].
struct LookSoFar {
  double share = 0.0, share_s = 0.0;  // of its tubes, and when it was told
  std::optional<double> tubes_s{};    // when they were done
  std::optional<double> edges_s{};    // when edges and waves over surfaces were done, too
  double passed_s = 0.0;
};

/// What the look of the plan takes at most [s]. Tubes: at the rate of those done, and as much again as a geometric series of less
/// dense ones takes, each density at least half as high again as the one before. Edges that were not done: thirty times what
/// has passed since the tubes were, or where these were not thirty times their pass. Mechanisms with a budget: all of it.
double longest_look(const LookSoFar& look, const SolvePlan& plan);

/// Times looks spread over the sweep, on as many threads as the solve will have, for about `seconds` [s]; looks that take longer
/// than `patience` [s] are given up, and in as long again a bound is found. The only thing it decides is what is said about it.
TimePrediction predict_time(const SolvePlan& plan, double seconds, double patience);

}  // namespace raytube
