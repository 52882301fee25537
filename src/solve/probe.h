// How long a solve will take, from a few of its looks.
#pragma once

#include "solve/plan.h"

namespace raytube {

struct TimePrediction {
  double solve_s = 0.0;   // of the whole solve on its threads, as Statistics::solve_s [s]
  double look_s = 0.0;    // of one look on one thread, on average [s]
  std::size_t looks = 0;  // that were timed
  bool at_least = false;  // the first looks were not done in time: the solve takes longer than this
};

/// Times looks spread over the sweep, on as many threads as the solve will have, for about `seconds` [s]; looks that take longer
/// than `patience` [s] are given up. The only thing it decides is what is said about it.
TimePrediction predict_time(const SolvePlan& plan, double seconds, double patience);

}  // namespace raytube
