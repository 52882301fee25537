#include "program/helping.h"

#include <fmt/format.h>

#include <optional>

#include "case/read_case.h"
#include "core/threads.h"
#include "jobs/shared_work.h"
#include "jobs/solvable.h"
#include "mesh/model/mesh_bytes.h"
#include "ranks/ranks.h"
#include "solve/random.h"
#include "solve/solve.h"

namespace raytube {

namespace {

std::filesystem::path case_of(const Request& request) {
  const bool is_product = request.action == profile_command || request.action == isar_command;
  return is_product ? request.result : request.case_file;
}

// What all ranks have to agree on, but for the mesh.
JournalIdentity work_of(const Request& request, const Case& c) {
  JournalIdentity asked{{"command", request.words.front()}, {"--densities", request.densities}};
  if (const auto& random = request.random)
    asked.emplace_back("--launch random", fmt::format("{} {} {}", random->samples, random->seed, random->runs));
  return shared_work(c, asked);
}

void help_with(const Request& request, const Case& c, const Target& target) {
  if (request.action == converge_command) return help_to_converge(request, c, target);
  const SolvePlan plan = plan_of_case(target, c, request.threads, request.parts || request.random);
  if (request.random) return help_with_random_tubes(plan, *request.random, request.ranks->team());
  help_to_solve(plan, request.ranks->team());
}

}  // namespace

WorkTeam* team_of(const Request& request) { return request.ranks ? &request.ranks->team() : nullptr; }

void share_work(const Request& request, const Case& c, const TriangleMesh& mesh) {
  if (!request.ranks) return;
  std::string work = text_of_work(work_of(request, c)), bytes = bytes_of_mesh(mesh);
  request.ranks->broadcast(work);
  request.ranks->broadcast(bytes);
}

// What the user has got wrong the leader finds before it shares the mesh.
void help_command(const Request& request) {
  std::string work, bytes;
  request.ranks->broadcast(work);
  request.ranks->broadcast(bytes);
  const Case c = read_case(case_of(request), request.overrides);
  require_same_work(work_of_text(work), work_of(request, c));
  std::optional<Target> target;
  run_on_threads(request.threads, [&] { target.emplace(mesh_of_bytes(bytes), c.wedges); });
  bytes = {};
  help_with(request, c, *target);
  request.ranks->end();
}

}  // namespace raytube
