// raytube merge: the shards of a run -> the results of one run.
#include <CLI/CLI.hpp>

#include "case/read_case.h"
#include "program/run/run_results.h"
#include "program/run/shard_files.h"
#include "program/work/look_journal.h"

namespace raytube {

namespace {

constexpr const char* merge_examples =
    R"(Writes the results of one run, byte for byte, once all shards of one case, mesh and program are there.

Examples:
  raytube run case.toml --shard 1/2 -o shards; raytube run case.toml --shard 2/2 -o shards; raytube merge shards
  raytube merge shards -o result.nc)";

struct MergeRequest {
  std::filesystem::path shards;  // their folder
  RunOptions run;                // where its case or folder is not given, that of the shards
};

void merge_shards(const MergeRequest& asked) {
  const Stopwatch total;
  const ShardFiles shards(asked.shards);
  RunOptions run = asked.run;
  if (run.input.file.empty()) run.input.file = shards.case_file();
  run.input.overrides = shards.overrides();
  if (run.output.empty()) run.output = asked.shards;
  const Case read = read_case(run.input.file, run.input.overrides);
  const Destination destination = destination_of(run.output, {}, "rcs.csv");
  const Case c = case_for(destination, run, read);
  check_output(destination.folder, names_of_results(run, c, destination), input_files(c));
  LookJournal::refuse_leftover(LookJournal::file_in(destination.folder));
  PreparedRun prepared = prepared_run(run, read, c, total);
  const std::size_t looks = prepared.planned->items();
  shards.require(identity_of(c, prepared.manifest), looks);
  const MergedLooks merged{shards.looks(), looks};
  run_into_folder({run, prepared, destination, &merged, nullptr, total});
}

}  // namespace

CLI::App& add_merge(CommandLine& line) {
  const auto asked = std::make_shared<MergeRequest>();
  RunOptions& run = asked->run;
  CLI::App& merge = add_command(line, "merge", "Combine the shards of a run", merge_examples);
  add_value(merge, "shards DIR", asked->shards, "Folder of the shards")->required();
  add_value(merge, "case CASE.toml", run.input.file, "Case file (TOML), if it is no longer where the shards were made");
  add_output_option(merge, run.output, "Folder for the results, or FILE.nc; default that of the shards");
  add_machine_options(line, merge, run.work);
  merge.add_flag("--parts", run.parts, "Also write parts.csv: S by mechanism");
  add_quiet_option(merge, run.work.quiet, "summary");
  return set_action(line, merge, [asked] { merge_shards(*asked); });
}

}  // namespace raytube
