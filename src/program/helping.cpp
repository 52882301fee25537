#include "program/helping.h"

#include <fmt/format.h>

#include <optional>

#include "case/read_case.h"
#include "case/target.h"
#include "core/threads.h"
#include "jobs/shared_work.h"
#include "jobs/solve_case.h"
#include "mesh/model/mesh_bytes.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

// Everything that the processes must agree on, except for the mesh.
JournalIdentity identity_of_work(const Work& work, JournalIdentity asked, const Case& c) {
  asked.insert(asked.begin(), {"command", work.command});
  return shared_work(c, asked);
}

}  // namespace

WorkTeam* team_of(const Work& work) { return work.ranks ? &work.ranks->team() : nullptr; }

void share_work(const Work& work, const JournalIdentity& asked, const Case& c, const TriangleMesh& mesh) {
  if (!work.ranks) return;
  std::string identity = text_of_work(identity_of_work(work, asked, c)), bytes = bytes_of_mesh(mesh);
  work.ranks->broadcast(identity);
  work.ranks->broadcast(bytes);
}

// The leader finds the user's mistakes before it shares the mesh.
void help_leader(const Work& work, const CaseInput& input, const JournalIdentity& asked,
                 const std::function<void(const Case&, const Target&)>& compute) {
  std::string identity, bytes;
  work.ranks->broadcast(identity);
  work.ranks->broadcast(bytes);
  const Case c = read_case(input.file, input.overrides);
  require_same_work(work_of_text(identity), identity_of_work(work, asked, c));
  std::optional<Target> target;
  run_on_threads(work.threads, [&] { target.emplace(mesh_of_bytes(bytes), c.wedges); });
  bytes = {};
  compute(c, *target);
  work.ranks->end();
}

void help_to_run(const RunOptions& run) {
  help_leader(run.work, run.input, {}, [&](const Case& c, const Target& target) {
    const auto moving = c.motion ? std::make_shared<const MovingTarget>(read_target(c), c) : nullptr;
    help_to_solve_case(c, target, run.work.threads, run.parts, run.work.ranks->team(), {}, moving);
  });
}

}  // namespace raytube
