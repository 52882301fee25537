// How much memory a solve will take, before it begins.
#pragma once

#include "plan/plan.h"

namespace raytube {

/// What grows with a sweep [bytes]. How dense the tubes are is not in it: tiles are streamed.
struct MemoryEstimate {
  double rows = 0.0;   // what a row takes times their number, and of each look a little
  double sums = 0.0;   // of looks under way, on all threads
  double edges = 0.0;  // sets of edges, one for all frequencies at which the same plates are thin

  double total() const { return rows + sums + edges; }
};

/// Upper bound but for what threads and libraries take for themselves: a target may have fewer bounces than `max_bounces`.
MemoryEstimate estimate_memory(const SolvePlan& plan);

}  // namespace raytube
