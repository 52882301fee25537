#include "solve/solve.h"

#include <chrono>

#include "core/threads.h"
#include "solve/look_solver.h"
#include "solve/rows.h"
#include "solve/shared_items.h"
#include "solve/sum_of_paths.h"

namespace raytube {

namespace {

SharedItems<LookResult> looks_of(const SolvePlan& plan, const LookSolver& solver) {
  return {plan.looks.computed.size(), plan.threads,
          [&](std::size_t index, Progress& progress, double share) {
            LookResult found = solver.solve(plan.looks.computed[index], progress, share);
            stop_if_cancelled();
            found.keep_sums_only();
            return found;
          },
          look_bytes,
          [&](const std::string& bytes) { return look_of_bytes(bytes, plan.sweep.frequencies.size(), plan.mechanisms.size()); }};
}

}  // namespace

SweepResult solve(const SolvePlan& plan, const std::function<bool(double)>& callback, const KeptLooks& kept, WorkTeam* team) {
  const auto start = std::chrono::steady_clock::now();
  if (kept.begin) kept.begin(plan.looks.computed.size());
  const LookSolver solver(plan);
  // The rows of each look, and of those that repeat it or are its mirror image.
  Rows rows(plan, solver.model_uncertainty(), solver.edge_lengths());
  compute_shared<LookResult>(looks_of(plan, solver), {}, callback, kept, team,
                             [&rows](std::size_t index, const LookResult& look) { rows.add(index, look); });
  SweepResult result = plan.ground ? sum_of_paths(plan, rows.finish()) : rows.finish();
  result.statistics.solve_s = plan.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void solve_shard(const SolvePlan& plan, const Shard& shard, const std::function<bool(double)>& callback, const KeptLooks& kept,
                 WorkTeam* team) {
  const LookSolver solver(plan);
  compute_shard(looks_of(plan, solver), shard, callback, kept, team);
}

void help_to_solve(const SolvePlan& plan, WorkTeam& team, const std::function<bool(double)>& callback) {
  const LookSolver solver(plan);
  compute_for_leader(looks_of(plan, solver), team, callback);
}

SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options) {
  return solve(SolvePlan(target, sweep, options), options.progress, options.kept, options.team);
}

}  // namespace raytube
