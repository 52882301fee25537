// raytube merge: the shards of a run -> what one run would have written.
#include "case/read_case.h"
#include "core/error.h"
#include "jobs/inputs.h"
#include "program/run/run_results.h"
#include "program/run/shard_files.h"
#include "program/work/look_journal.h"

namespace raytube {

namespace {

// The run that the shards are of, with what is asked of its results.
Request merged_run(const Request& request, const ShardFiles& shards) {
  Request run = request;
  if (run.case_file.empty()) run.case_file = shards.case_file();
  run.overrides = shards.overrides();
  if (run.output_folder.empty()) run.output_folder = request.merged_folder;
  return run;
}

}  // namespace

void merge_command(const Request& request) {
  const Stopwatch total;
  const ShardFiles shards(request.merged_folder);
  const Request run = merged_run(request, shards);
  const Case read = read_case(run.case_file, run.overrides);
  const Destination destination = destination_of(run.output_folder, {}, "rcs.csv");
  const Case c = case_for(destination, run, read);
  check_output(destination.folder, names_of_results(run, c, destination), input_files(c));
  LookJournal::refuse_leftover(LookJournal::file_in(destination.folder));
  PreparedRun prepared = prepared_run(run, read, c, total);
  const std::size_t looks = prepared.planned->plan.looks.computed.size();
  shards.require(identity_of(c, prepared.manifest), looks);
  const MergedLooks merged{shards.looks(), looks};
  run_into_folder(run, prepared, destination, &merged, total);
}

}  // namespace raytube
