// raytube check: what a run would do, without doing it.
#include <fmt/format.h>

#include <algorithm>

#include "case/read_case.h"
#include "case/target.h"
#include "core/threads.h"
#include "jobs/check_report.h"
#include "jobs/memory.h"
#include "jobs/solvable.h"
#include "program/commands.h"
#include "program/wedge_list.h"

namespace raytube {

namespace {

void write_wedges(const std::filesystem::path& file, const Target& target, const Sweep& sweep) {
  const double highest = std::ranges::max(sweep.frequencies);
  const std::vector<Wedge> used = merge_thin_plate_edges(target.wedges, target.thin_plate_edges, thin_limit(highest));
  write_wedges_csv(file, target.mesh, used, sweep);
}

}  // namespace

void check_command(const Request& request) {
  const Case c = read_case(request.case_file, request.overrides);
  if (!request.wedges_csv.empty()) check_wedges_file(request.wedges_csv);
  LoadedMesh loaded = load_target(c);
  const Target target(std::move(loaded.mesh), c.wedges);
  const SolvePlan plan = plan_of_case(target, c, request.threads > 0 ? request.threads : all_threads(), false);
  CheckReport report([](const std::string& text) { fmt::print("{}", text); });
  tell_case(report, c, loaded.report, plan);
  if (!request.wedges_csv.empty()) write_wedges(request.wedges_csv, target, c.sweep);
  check_memory(plan, c, nullptr);  // as a run would
  tell_time(report, plan);
}

}  // namespace raytube
