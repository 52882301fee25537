// raytube check: what a run would do, without doing it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "case/read_case.h"
#include "case/target.h"
#include "core/error.h"
#include "core/threads.h"
#include "jobs/check_report.h"
#include "jobs/check_text.h"
#include "jobs/memory.h"
#include "jobs/retrace.h"
#include "jobs/solvable.h"
#include "output/tables/wedges_csv.h"
#include "output/vtk/wedges_vtp.h"
#include "program/options.h"
#include "program/work/results.h"
#include "utd/shadow/wedge_lines.h"

namespace raytube {

namespace {

constexpr const char* check_examples =
    R"(Prints the resolved case, the mesh report, the wedges, what will be skipped and the expected cost.

Examples:
  raytube check case.toml --set target.unit=mm
  raytube check case.toml --threads 8
  raytube check case.toml --ranks 64 --threads 4
  raytube check case.toml --wedges wedges.csv
  raytube check case.toml --wedges wedges.vtp)";

struct CheckRequest {
  CaseInput input;
  int threads = 0;                   // 0: all cores
  int ranks = 0;                     // processes of a planned job; 0: none
  std::filesystem::path wedge_list;  // empty: none wanted
  bool json = false;
};

bool wants_lines(const std::filesystem::path& file) { return file.extension() == ".vtp"; }

std::filesystem::path folder_of_wedges(const std::filesystem::path& file) {
  if (file.extension() != ".csv" && !wants_lines(file))
    throw InputError(
        fmt::format("--wedges {}: a list of wedges is a table or lines for ParaView; name a .csv or a .vtp", file.string()));
  return folder_of_named_file("--wedges", file, wants_lines(file) ? wedges_vtp_head : wedges_csv_head);
}

// The wedges at the highest frequency, without those that are flat to it; lit or not by the transmitter of the first look.
void write_wedges(const std::filesystem::path& file, const SolvePlan& plan) {
  const std::vector<double>& frequencies = plan.sweep.frequencies;
  const auto highest = static_cast<std::size_t>(std::ranges::max_element(frequencies) - frequencies.begin());
  std::vector<Wedge> used = *set_of(plan.wedge_sets, highest).wedges;
  std::erase_if(used, &Wedge::flat);
  const std::vector<WedgeLine> lines =
      wedge_lines(plan.target.mesh, used, plan.sweep.looks.front(), wavelength(frequencies[highest]));
  NewResults results(folder_of_wedges(file));
  const std::filesystem::path written = results.folder() / file.filename();
  wants_lines(file) ? write_wedges_vtp(written, lines) : write_wedges_csv(written, lines);
  results.place({file.filename().string()});
}

void check_case(const CheckRequest& asked) {
  const Case c = read_case(asked.input.file, asked.input.overrides);
  if (!asked.wedge_list.empty()) folder_of_wedges(asked.wedge_list);  // better refused now than after the work
  auto [moving, loaded] = load_target_of_plan(c);
  const Target target(std::move(loaded.mesh), c.wedges);
  const int threads = asked.threads > 0 ? asked.threads : all_threads();
  const Case part = case_of_plan(c, moving.get());
  const SolvePlan plan = plan_of_case(target, part, threads, false);
  Json data;
  const auto add = [&](const Json& section) {
    if (asked.json)
      data.update(section);
    else
      fmt::print("{}", check_text(section));  // at once: what follows takes seconds
  };
  const std::size_t plans = plans_of(c, moving.get());
  add(check_data(c, loaded.report, plan, moving.get(), plans));
  if (!asked.wedge_list.empty()) write_wedges(asked.wedge_list, plan);
  check_memory(plan, c);  // as a run would
  const MemoryOfRun memory = memory_of_run(plan, c);
  const TimePrediction time = predicted_time(plan, plans);
  add(time_data(plan, time));
  if (asked.ranks > 0) add(ranks_data(plan, memory, time, asked.ranks));
  if (asked.json) fmt::print("{}\n", text_of_json(data, 2));
}

}  // namespace

CLI::App& add_check(CommandLine& line) {
  const auto asked = std::make_shared<CheckRequest>();
  CLI::App& check = add_command(line, "check", "Report on a case without computing it", check_examples);
  add_case_options(check, asked->input);
  add_threads_option(check, asked->threads);
  add_value(check, "--ranks N", asked->ranks,
            "Also predict time and memory of a job of N processes (mpirun -n N) with --threads threads each",
            whole_number(1, 1000000));
  add_json_option(check, asked->json);
  add_value(check, "--wedges FILE.csv|FILE.vtp", asked->wedge_list,
            "Also write a list of all wedges: a table, or lines for ParaView");
  return set_action(line, check, [asked] { check_case(*asked); });
}

}  // namespace raytube
