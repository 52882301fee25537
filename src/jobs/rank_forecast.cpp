#include "jobs/rank_forecast.h"

#include <algorithm>
#include <cmath>

#include "jobs/memory.h"

namespace raytube {

namespace {

// A look begun last ends up to one look after all others.
double seconds_of(const SolvePlan& plan, const TimePrediction& time, int ranks) {
  const double threads = static_cast<double>(ranks) * plan.threads, looks = static_cast<double>(plan.looks.computed.size());
  const double setup = std::max(0.0, time.solve_s - time.look_s * looks / plan.threads);
  return setup + time.look_s * std::max(1.0, looks / threads + 0.5 * (1.0 - 1.0 / threads));
}

std::string count_text(std::size_t count, const char* what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

}  // namespace

RankMemory memory_of_ranks(const SolvePlan& plan, const Case& c) {
  return {memory_of_run(plan, c, nullptr), memory_of_helper(plan, c)};
}

void tell_ranks(CheckReport& report, const SolvePlan& plan, const RankMemory& memory, const TimePrediction& time, int ranks) {
  const double seconds = seconds_of(plan, time, ranks);
  const auto threads = static_cast<std::size_t>(plan.threads), all = static_cast<std::size_t>(ranks) * threads,
             looks = plan.looks.computed.size();
  report.data["ranks"] = {
      {"count", ranks}, {"solve_s", seconds}, {"leader_memory_bytes", memory.leader}, {"memory_bytes", memory.other}};
  report.print("\nranks\n  {} {} on {} of {}; at most about {} of memory for rank 0, {} for each other one\n",
               time.at_most ? "at most about" : "about", seconds_text(seconds),
               count_text(static_cast<std::size_t>(ranks), "rank"), count_text(threads, "thread"), memory_text(memory.leader),
               memory_text(memory.other));
  if (all > looks)
    report.print("  there are only {} looks to be computed: {} of {} would do as well\n", looks,
                 count_text((looks + threads - 1) / threads, "rank"), count_text(threads, "thread"));
}

}  // namespace raytube
