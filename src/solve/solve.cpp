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

// One kept from an earlier solve, if there is.
std::optional<LookResult> kept_look(const KeptLooks& kept, std::size_t index, std::size_t frequencies) {
  if (!kept.find) return {};
  const std::string bytes = kept.find(index);
  return bytes.empty() ? std::nullopt : look_of_bytes(bytes, frequencies);
}

using LookDone = std::function<void(std::size_t index, const LookResult& look)>;

// Those that the team leaves to this process. Looks run side by side, tiles within a look too; every sum is taken in index order,
// so threads never show in the result.
void compute_looks(const SolvePlan& plan, const LookSolver& solver, WorkTeam& team, Progress& progress, double share,
                   const LookDone& done) {
  compute_items(team, plan.looks.computed.size(), plan.threads, [&](std::size_t index) {
    // Tubes, then edges, then edges on faces: physical optics of every bounce and what it lacks.
    LookResult found = solver.solve(plan.looks.computed[index], progress, share);
    stop_if_cancelled();
    found.keep_sums_only();
    done(index, found);
  });
}

// Kept looks before all others, so that whoever is told of the progress sees at what rate the others are computed.
std::vector<bool> take_kept(const SolvePlan& plan, const KeptLooks& kept, Progress& progress, double share,
                            const LookDone& done) {
  std::vector<char> known(plan.looks.computed.size());
  tbb::parallel_for(std::size_t{0}, known.size(), [&](std::size_t index) {
    const std::optional<LookResult> look = kept_look(kept, index, plan.sweep.frequencies.size());
    if (!look) return;
    done(index, *look);
    known[index] = 1;
    progress.add(share);
  });
  progress.add(0.0);
  return {known.begin(), known.end()};
}

}  // namespace

SweepResult solve(const SolvePlan& plan, const std::function<bool(double)>& callback, const KeptLooks& kept, WorkTeam* team) {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t looks = plan.looks.computed.size(), frequencies = plan.sweep.frequencies.size();
  if (kept.begin) kept.begin(looks);
  const LookSolver solver(plan);
  // The rows of each look, and of those that repeat it or are its mirror image.
  Rows rows(plan, solver.model_uncertainty(), solver.edge_lengths());
  Progress progress(callback);
  const double share = 1.0 / static_cast<double>(looks);
  const LookDone add = [&rows](std::size_t index, const LookResult& look) { rows.add(index, look); };
  const auto take = [&](std::size_t index, std::string bytes) {
    add(index, look_of_bytes(bytes, frequencies).value());
    if (kept.keep) kept.keep(index, std::move(bytes));
    progress.add(share);
  };
  TeamOfOne alone;
  WorkTeam& all = team ? *team : alone;
  run_on_threads(plan.threads, [&] {
    TeamMember leader(all, take_kept(plan, kept, progress, share, add), take);
    compute_looks(plan, solver, all, progress, share, [&](std::size_t index, const LookResult& look) {
      add(index, look);
      if (kept.keep) kept.keep(index, look_bytes(look));
    });
    leader.finish();
  });
  SweepResult result = plan.ground ? sum_of_paths(plan, rows.finish()) : rows.finish();
  result.statistics.solve_s = plan.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void solve_shard(const SolvePlan& plan, const Shard& shard, const std::function<bool(double)>& callback, const KeptLooks& kept,
                 WorkTeam* team) {
  const std::size_t looks = plan.looks.computed.size(), own = shard.size(looks);
  if (kept.begin) kept.begin(own);
  if (own == 0 && !team) return;
  const LookSolver solver(plan);
  Progress progress(callback);
  const double share = 1.0 / static_cast<double>(own);
  TeamOfOne alone;
  WorkTeam& all = team ? *team : alone;
  run_on_threads(plan.threads, [&] {
    std::vector<bool> done = take_kept(plan, kept, progress, share, [](std::size_t, const LookResult&) {});
    for (std::size_t index = 0; index < looks; ++index) done[index] = done[index] || !shard.has(index);
    TeamMember leader(all, done, [&](std::size_t index, std::string bytes) {
      kept.keep(index, std::move(bytes));
      progress.add(share);
    });
    compute_looks(plan, solver, all, progress, share,
                  [&](std::size_t index, const LookResult& look) { kept.keep(index, look_bytes(look)); });
    leader.finish();
  });
}

void help_to_solve(const SolvePlan& plan, WorkTeam& team, const std::function<bool(double)>& callback) {
  const LookSolver solver(plan);
  Progress progress(callback);
  run_on_threads(plan.threads, [&] {
    TeamMember member(team, std::vector<bool>(plan.looks.computed.size()), {});
    compute_looks(plan, solver, team, progress, 0.0,
                  [&](std::size_t index, const LookResult& look) { team.give(index, look_bytes(look)); });
    member.finish();
  });
}

SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options) {
  return solve(SolvePlan(target, sweep, options), options.progress, options.kept, options.team);
}

}  // namespace raytube
