// raytube run: case -> mesh -> solve -> files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "case/read_case.h"
#include "core/error.h"
#include "core/work_sharing.h"
#include "jobs/shared_work.h"
#include "output/files/earlier_results.h"
#include "program/helping.h"
#include "program/run/case_of_mesh.h"
#include "program/run/run_results.h"
#include "program/run/shard.h"
#include "program/work/look_journal.h"

namespace raytube {

namespace {

constexpr const char* run_examples =
    R"(Writes rcs.csv, channels.csv, rcs.png, rcs.svg and run.json. If interrupted, it keeps its finished looks for --resume.
-o FILE.nc writes that netCDF file alone, which holds all of rcs.csv, the mechanisms and the resolved case.
A mesh in place of the case takes --unit, --ghz and --azimuth; the case made from them is written as case.toml beside the results.

Examples:
  raytube run cases/dihedral/case.toml
  raytube run car.stl --unit m --ghz 10 --azimuth 0:360:1
  raytube run case.toml -o results --threads 4 --parts
  raytube run case.toml --set tubes.per_wavelength=20 --set edges.method=none
  raytube run case.toml --resume
  raytube run case.toml -o result.nc
  raytube run case.toml --shard 3/7 -o shards      (one of seven; then raytube merge shards))";

struct RunRequest {
  RunOptions run;
  MeshOptions mesh;
};

void refuse_contradictions(const RunOptions& run) {
  if (run.shard && run.parts)
    throw InputError("--parts: shards always keep the mechanisms; leave it out, and give it to raytube merge");
}

// True if the folder holds all results of this run. Throws InputError if it holds those of a finished run of another case.
bool is_finished(const RunOptions& asked, const PreparedRun& prepared, const Destination& destination) {
  const std::filesystem::path& folder = destination.folder;
  const EarlierResults earlier(folder);
  if (std::filesystem::exists(LookJournal::file_in(folder)) || !earlier.hold("run.json")) return false;
  std::ifstream file(folder / "run.json");
  const Json run = Json::parse(file);
  JournalIdentity identity = identity_of(prepared.c, prepared.manifest);
  std::erase_if(identity, [](const auto& item) { return item.first == program_item; });
  if (const std::string found = differences_text(identity_of_run(run), identity); !found.empty())
    throw InputError(
        fmt::format("--resume: {} holds the results of a finished run with {}; choose another folder with -o DIR, or "
                    "leave out --resume to replace them",
                    folder.string(), found));
  return std::ranges::all_of(names_of_results(asked, prepared.c, destination).tables,
                             [&](const std::string& name) { return earlier.hold(name); });
}

}  // namespace

void run_case(const RunOptions& run, Product* product) {
  const Stopwatch total;
  const Case read = read_case(run.input.file, run.input.overrides);
  if (run.shard) return run_shard(run, read, total);
  const Destination destination = destination_of(run.output, read.file.parent_path() / "out", "rcs.csv");
  const Case c = case_for(destination, run, read);
  const ResultNames names = names_of_results(run, c, destination, product ? product->names : ResultNames{});
  check_output(destination.folder, names, input_files(c));
  if (!run.resume) LookJournal::refuse_leftover(LookJournal::file_in(destination.folder));
  PreparedRun prepared = prepared_run(run, read, c, total);
  if (run.resume && is_finished(run, prepared, destination)) {
    if (WorkTeam* const team = team_of(run.work)) TeamMember(*team, std::vector(prepared.planned->items(), true), {}).finish();
    if (product) {
      RunOptions finished = run;
      finished.input = {result_in(destination.folder), {}};
      finished.resume = false;
      finished.work.ranks = nullptr;
      make_product(finished, *product);
    } else if (!run.work.quiet) {
      fmt::print("{}: this run is finished already; nothing was changed\n", destination.text());
    }
    return;
  }
  if (product) {
    product->source = source_of(c, prepared.target);
    product->check();
  }
  run_into_folder({run, prepared, destination, nullptr, product, total});
}

CLI::App& add_run(CommandLine& line) {
  const auto asked = std::make_shared<RunRequest>();
  RunOptions& options = asked->run;
  CLI::App& run = add_command(line, "run", "Compute a case and write the results", run_examples);
  add_value(run, "case CASE.toml|MESH", options.input.file, "Case file (TOML), or a mesh with --unit and --ghz")->required();
  add_set_option(run, options.input);
  add_mesh_options(run, asked->mesh);
  add_output_option(run, options.output, "Folder for the results, or FILE.nc; default <case folder>/out");
  add_machine_options(line, run, options.work);
  run.add_flag("--parts", options.parts, "Also write parts.csv and parts.png: S by mechanism");
  run.add_flag("--resume", options.resume, "Continue an interrupted run: keep the finished looks in the folder");
  add_value(run, "--shard I/N|slurm", options.shard,
            "Compute (or continue) part I of N of the looks, for raytube merge; slurm: the task of a job array");
  add_quiet_option(run, options.work.quiet, "summary");
  const auto act = [asked] {
    refuse_contradictions(asked->run);
    make_case_of_mesh(asked->mesh, asked->run);
    run_case(asked->run, nullptr);
  };
  return set_action(line, run, act, [asked] { help_to_run(asked->run); });
}

}  // namespace raytube
