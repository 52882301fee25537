// raytube check: what a run would do, without doing it.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "case/read_case.h"
#include "case/target.h"
#include "core/threads.h"
#include "jobs/check_report.h"
#include "jobs/check_text.h"
#include "jobs/memory.h"
#include "jobs/rank_forecast.h"
#include "jobs/solvable.h"
#include "program/commands.h"
#include "program/wedge_list.h"

namespace raytube {

namespace {

// As the highest frequency has them, without those that are flat to it.
void write_wedges(const std::filesystem::path& file, const SolvePlan& plan) {
  const std::vector<double>& frequencies = plan.sweep.frequencies;
  const auto highest = static_cast<std::size_t>(std::ranges::max_element(frequencies) - frequencies.begin());
  std::vector<Wedge> used = *set_of(plan.wedge_sets, highest).wedges;
  std::erase_if(used, &Wedge::flat);
  write_wedge_list(file, plan.target.mesh, used, plan.sweep);
}

}  // namespace

void check_command(const Request& request) {
  const Case c = read_case(request.case_file, request.overrides);
  if (!request.wedge_list.empty()) check_wedges_file(request.wedge_list);
  LoadedMesh loaded = load_target(c);
  const Target target(std::move(loaded.mesh), c.wedges);
  const SolvePlan plan = plan_of_case(target, c, request.threads > 0 ? request.threads : all_threads(), false);
  Json data;
  const auto add = [&](const Json& section) {
    if (request.json)
      data.update(section);
    else
      fmt::print("{}", check_text(section));  // at once: what follows takes seconds
  };
  add(check_data(c, loaded.report, plan));
  if (!request.wedge_list.empty()) write_wedges(request.wedge_list, plan);
  check_memory(plan, c, nullptr);  // as a run would
  const RankMemory memory = memory_of_ranks(plan, c);
  const TimePrediction time = predicted_time(plan);
  add(time_data(plan, time));
  if (request.planned_ranks > 0) add(ranks_data(plan, memory, time, request.planned_ranks));
  if (request.json) fmt::print("{}\n", text_of_json(data, 2));
}

}  // namespace raytube
