#include "jobs/rank_forecast.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "jobs/memory.h"

namespace raytube {

namespace {

// A look begun last ends up to one look after all others.
double seconds_of(const SolvePlan& plan, const TimePrediction& time, int ranks) {
  const double threads = static_cast<double>(ranks) * plan.threads, looks = static_cast<double>(plan.looks.computed.size());
  const double setup = std::max(0.0, time.solve_s - time.look_s * looks / plan.threads);
  return setup + time.look_s * std::max(1.0, looks / threads + 0.5 * (1.0 - 1.0 / threads));
}

}  // namespace

RankMemory memory_of_ranks(const SolvePlan& plan, const Case& c) { return {memory_of_run(plan, c), memory_of_helper(plan, c)}; }

Json ranks_data(const SolvePlan& plan, const RankMemory& memory, const TimePrediction& time, int ranks) {
  return {{"ranks",
           {{"count", ranks},
            {"threads", plan.threads},
            {"looks", plan.looks.computed.size()},
            {"solve_s", seconds_of(plan, time, ranks)},
            {"at_most", time.at_most},
            {"leader_memory_bytes", memory.leader},
            {"memory_bytes", memory.other}}}};
}

}  // namespace raytube
