#include "solve/solve.h"

#include <tbb/parallel_for.h>

#include <chrono>
#include <optional>
#include <vector>

#include "core/threads.h"
#include "core/work_sharing.h"
#include "solve/look_solver.h"
#include "solve/rows.h"
#include "solve/sum_of_paths.h"

namespace raytube {

namespace {

std::optional<LookResult> look_of(const SolvePlan& plan, const std::string& bytes) {
  return look_of_bytes(bytes, plan.sweep.frequencies.size(), plan.mechanisms.size());
}

// What is done with each look that is computed here, found by another process, or kept from before; in any order.
using LookDone = std::function<void(std::size_t index, const LookResult& look)>;

// Takes the looks that are kept, and says which these are.
std::vector<bool> take_kept(const SolvePlan& plan, const KeptLooks& kept, Progress& progress, double share,
                            const LookDone& done) {
  std::vector<char> known(plan.looks.computed.size());
  tbb::parallel_for(std::size_t{0}, known.size(), [&](std::size_t index) {
    const std::string bytes = kept.find ? kept.find(index) : "";
    const std::optional<LookResult> look = bytes.empty() ? std::nullopt : look_of(plan, bytes);
    if (!look) return;
    if (done) done(index, *look);
    known[index] = 1;
    progress.add(share);
  });
  progress.add(0.0);
  return {known.begin(), known.end()};
}

// Takes the looks kept from an earlier solve first, so that the progress shows the rate of the new ones; then computes those of
// the shard that the team hands to this process. Each new look is handed to kept.keep, every look to `done`. Looks run side by
// side, tiles within a look too; every sum is taken in index order, so threads never show in the result.
void compute_looks(const SolvePlan& plan, const LookSolver& solver, const Shard& shard,
                   const std::function<bool(double)>& callback, const KeptLooks& kept, WorkTeam* team, const LookDone& done) {
  const std::size_t looks = plan.looks.computed.size();
  TeamOfOne alone;
  WorkTeam& all = team ? *team : alone;
  Progress progress(callback);
  const double share = all.leads() ? 1.0 / static_cast<double>(shard.size(looks)) : 0.0;
  run_on_threads(plan.threads, [&] {
    std::vector<bool> known = all.leads() ? take_kept(plan, kept, progress, share, done) : std::vector<bool>(looks);
    for (std::size_t index = 0; index < looks; ++index) known[index] = known[index] || !shard.has(index);
    TeamMember member(all, known, [&](std::size_t index, std::string bytes) {
      if (done) done(index, look_of(plan, bytes).value());
      if (kept.keep) kept.keep(index, std::move(bytes));
      progress.add(share);
    });
    compute_items(all, looks, plan.threads, [&](std::size_t index) {
      LookResult found = solver.solve(plan.looks.computed[index], progress, share);
      stop_if_cancelled();
      found.keep_sums_only();
      if (done) done(index, found);
      if (kept.keep) kept.keep(index, look_bytes(found));
    });
    member.finish();
  });
}

}  // namespace

SweepResult solve(const SolvePlan& plan, const std::function<bool(double)>& callback, const KeptLooks& kept, WorkTeam* team) {
  const auto start = std::chrono::steady_clock::now();
  if (kept.begin) kept.begin(plan.looks.computed.size());
  const LookSolver solver(plan);
  // The rows of each look, and of those that repeat it or are its mirror image.
  Rows rows(plan, solver.model_uncertainty(), solver.edge_lengths());
  compute_looks(plan, solver, {}, callback, kept, team,
                [&rows](std::size_t index, const LookResult& look) { rows.add(index, look); });
  SweepResult result = plan.ground ? sum_of_paths(plan, rows.finish()) : rows.finish();
  result.statistics.solve_s = plan.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void solve_shard(const SolvePlan& plan, const Shard& shard, const std::function<bool(double)>& callback, const KeptLooks& kept,
                 WorkTeam* team) {
  const std::size_t own = shard.size(plan.looks.computed.size());
  if (kept.begin) kept.begin(own);
  if (own > 0 || team) compute_looks(plan, LookSolver(plan), shard, callback, kept, team, {});
}

void help_to_solve(const SolvePlan& plan, WorkTeam& team, const std::function<bool(double)>& callback) {
  const KeptLooks given{
      .begin = {}, .find = {}, .keep = [&team](std::size_t index, std::string bytes) { team.give(index, std::move(bytes)); }};
  compute_looks(plan, LookSolver(plan), {}, callback, given, &team, {});
}

SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options) {
  return solve(SolvePlan(target, sweep, options), options.progress, options.kept, options.team);
}

}  // namespace raytube
