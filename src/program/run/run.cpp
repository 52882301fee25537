// raytube run: case -> mesh -> solve -> files.
#include "case/read_case.h"
#include "core/error.h"
#include "jobs/inputs.h"
#include "program/run/run_results.h"
#include "program/run/shard.h"
#include "program/work/look_journal.h"

namespace raytube {

namespace {

// What random tubes cannot be asked for.
void refuse_random_tubes(const Case& c) {
  if (!c.image_looks.empty())
    throw InputError(
        c.file.string() +
        ": output.image_look: an image adds up to the deterministic S, not to the mean of random tubes; leave out one");
  if (c.incoherent)
    throw InputError(c.file.string() +
                     ": output.incoherent: random tubes do not add up what roughness scatters; remove it, or --launch random");
}

}  // namespace

void run_command(const Request& request) {
  const Stopwatch total;
  const Case read = read_case(request.case_file, request.overrides);
  if (request.shard) return run_shard(request, read, total);
  const Destination destination = destination_of(request.output_folder, read.file.parent_path() / "out", "rcs.csv");
  const Case c = case_for(destination, request, read);
  check_output(destination.folder, names_of_results(request, c, destination), input_files(c));
  if (!request.resume) LookJournal::refuse_leftover(LookJournal::file_in(destination.folder));
  if (request.random) refuse_random_tubes(c);
  PreparedRun prepared = prepared_run(request, read, c, total);
  run_into_folder(request, prepared, destination, nullptr, total);
}

}  // namespace raytube
