#include "program/run/prepared_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "case/target.h"
#include "core/instruction_set.h"
#include "core/threads.h"
#include "jobs/inputs.h"
#include "jobs/shared_work.h"
#include "output/files/sha256.h"
#include "program/helping.h"
#include "program/solve_warnings.h"
#include "scene/sampling.h"

namespace raytube {

JournalIdentity identity_of(const Case& c, const Manifest& manifest) {
  JournalIdentity identity{{program_item, manifest.program_version + ' ' + sha256_of_file("/proc/self/exe")},
                           {mesh_item, fmt::format("{}", fmt::join(manifest.mesh_sha256, " "))}};
  std::ranges::copy(identity_of_case(c, manifest), std::back_inserter(identity));
  return identity;
}

PreparedRun prepared_run(const RunOptions& asked, const Case& read, const Case& c, const Stopwatch& total) {
  LoadedMesh loaded = load_target(c);
  share_work(asked.work, {}, c, loaded.mesh);
  warn_of_reading(c, loaded.report);
  PreparedRun run{c, loaded.report, described_inputs(read, loaded.report, sha256_of_meshes(c, loaded.report)), {}, {}, {}};
  Manifest& manifest = run.manifest;
  manifest.time.read_s = total.seconds();
  manifest.threads = asked.work.threads > 0 ? asked.work.threads : all_threads();
  run_on_threads(manifest.threads, [&] { run.target = std::make_shared<const Target>(std::move(loaded.mesh), c.wedges); });
  manifest.time.build_s = total.seconds() - manifest.time.read_s;
  run.outermost = outermost_points(run.target->mesh.vertices);
  run.planned = std::make_unique<const PlannedCase>(run.c, *run.target, run.report, run.outermost, manifest.threads, asked.parts);
  warn_of_materials(c, run.report, *run.target, manifest);
  manifest.embree_instruction_set = name_of(allowed_instruction_set());
  manifest.own_instruction_set = name_of(std::max(allowed_instruction_set(), InstructionSet::avx2));
  return run;
}

}  // namespace raytube
