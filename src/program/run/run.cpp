// raytube run: case -> mesh -> solve -> files.
#include <fmt/format.h>

#include "case/read_case.h"
#include "core/error.h"
#include "core/work_sharing.h"
#include "jobs/inputs.h"
#include "program/helping.h"
#include "program/run/finished_run.h"
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
        ": output.image_look: an image adds up to the deterministic S, not to the mean of random tubes; leave out one of them");
  if (c.incoherent)
    throw InputError(c.file.string() +
                     ": output.incoherent: random tubes do not add up what roughness scatters; remove it, or --launch random");
}

// A product of a run that needs no more than its result.
Request of_finished(Request request, const Destination& destination) {
  request.result = result_in(destination.folder);
  request.resume = false;
  request.overrides.clear();
  request.ranks = nullptr;
  return request;
}

}  // namespace

void run_case(const Request& request, Product* product) {
  const Stopwatch total;
  const Case read = read_case(request.case_file, request.overrides);
  if (request.shard) return run_shard(request, read, total);
  const Destination destination = destination_of(request.output_folder, read.file.parent_path() / "out", "rcs.csv");
  const Case c = case_for(destination, request, read);
  const ResultNames names = names_of_results(request, c, destination, product ? product->names : ResultNames{});
  check_output(destination.folder, names, input_files(c));
  if (!request.resume) LookJournal::refuse_leftover(LookJournal::file_in(destination.folder));
  if (request.random) refuse_random_tubes(c);
  PreparedRun prepared = prepared_run(request, read, c, total);
  if (request.resume && is_finished(request, prepared, destination)) {
    if (WorkTeam* const team = team_of(request))
      TeamMember(*team, std::vector(prepared.planned->plan.looks.computed.size(), true), {}).finish();
    if (product) return make_product(of_finished(request, destination), *product);
    if (!request.quiet) fmt::print("{}: this run is finished already; nothing was changed\n", destination.text());
    return;
  }
  if (product) {
    product->source = source_of(c, prepared.target);
    product->check();
  }
  run_into_folder(request, prepared, destination, nullptr, total, product);
}

void run_command(const Request& request) { run_case(request, nullptr); }

}  // namespace raytube
