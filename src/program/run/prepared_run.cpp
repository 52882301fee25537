#include "program/run/prepared_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "case/materials/materials.h"
#include "case/target.h"
#include "core/instruction_set.h"
#include "core/threads.h"
#include "jobs/inputs.h"
#include "jobs/memory.h"
#include "jobs/shared_work.h"
#include "jobs/solvable.h"
#include "output/files/sha256.h"
#include "program/helping.h"
#include "program/solve_warnings.h"
#include "solve/random.h"

namespace raytube {

JournalIdentity identity_of(const Case& c, const Manifest& manifest) {
  JournalIdentity identity{{"version or build of raytube", manifest.program_version + ' ' + sha256_of_file("/proc/self/exe")},
                           {"mesh in target.mesh", fmt::format("{}", fmt::join(manifest.mesh_sha256, " "))}};
  std::ranges::copy(identity_of_case(c, manifest), std::back_inserter(identity));
  return identity;
}

PreparedRun prepared_run(const Request& request, const Case& read, const Case& c, const Stopwatch& total) {
  LoadedMesh loaded = load_target(c);
  share_work(request, c, loaded.mesh);
  warn_of_reading(c, loaded.report);
  PreparedRun run{c, loaded.report, described_inputs(read, loaded.report, sha256_of_meshes(c, loaded.report)), {}, {}};
  Manifest& manifest = run.manifest;
  manifest.time.read_s = total.seconds();
  manifest.threads = request.threads > 0 ? request.threads : all_threads();
  run_on_threads(manifest.threads, [&] { run.target = std::make_unique<const Target>(std::move(loaded.mesh), c.wedges); });
  run.plan = std::make_unique<const SolvePlan>(plan_of_case(*run.target, c, manifest.threads, request.parts || request.random));
  warn_of_materials(c, run.report, *run.target, manifest);
  manifest.time.build_s = total.seconds() - manifest.time.read_s - run.plan->seconds;  // planning is part of solving
  manifest.embree_instruction_set = name_of(allowed_instruction_set());
  manifest.own_instruction_set = name_of(std::max(allowed_instruction_set(), InstructionSet::avx2));
  check_memory(*run.plan, c, request.random ? &*request.random : nullptr);
  if (request.random) check_random_tubes(*run.plan, *request.random);
  return run;
}

}  // namespace raytube
