#include "solve/solve.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <optional>
#include <vector>

#include "core/threads.h"
#include "solve/look_solver.h"
#include "solve/rows.h"

namespace raytube {

namespace {

// One kept from an earlier solve, if there is.
std::optional<LookResult> kept_look(const KeptLooks& kept, std::size_t index, std::size_t frequencies) {
  if (!kept.find) return {};
  const std::string bytes = kept.find(index);
  return bytes.empty() ? std::nullopt : look_of_bytes(bytes, frequencies);
}

}  // namespace

SweepResult solve(const SolvePlan& plan, const std::function<bool(double)>& callback, const KeptLooks& kept) {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t looks = plan.looks.computed.size();
  if (kept.begin) kept.begin(looks);
  const LookSolver solver(plan);
  RowCollector rows(plan, solver.model_uncertainty(), solver.edge_lengths());
  Progress progress(callback);
  const double share = 1.0 / static_cast<double>(looks);
  std::vector<char> known(looks);

  const auto take_kept = [&](std::size_t index) {
    const std::optional<LookResult> look = kept_look(kept, index, plan.sweep.frequencies.size());
    if (!look) return;
    rows.add(index, *look);
    known[index] = 1;
    progress.add(share);
  };
  const auto solve_look = [&](std::size_t index) {
    if (known[index]) return;
    // Tubes, then edges, then edges on faces: physical optics of every bounce and what it lacks.
    LookResult found = solver.solve(plan.looks.computed[index], progress, share);
    stop_if_cancelled();
    found.keep_sums_only();
    // The rows of this look, and of those that repeat it or are its mirror image.
    rows.add(index, found);
    if (kept.keep) kept.keep(index, look_bytes(found));
  };

  // Looks run side by side, tiles within a look too; every sum is taken in index order, so threads never show in the result. A
  // thread that waits for the tiles of its look begins no other look: so many looks are under way as there are threads.
  run_on_threads(plan.threads, [&] {
    // Kept looks before all others, so that whoever is told of the progress sees at what rate the others are computed.
    tbb::parallel_for(std::size_t{0}, looks, take_kept);
    progress.add(0.0);
    tbb::parallel_for(std::size_t{0}, looks,
                      [&](std::size_t index) { tbb::this_task_arena::isolate([&] { solve_look(index); }); });
  });
  SweepResult result = rows.finish();
  result.statistics.solve_s = plan.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options) {
  return solve(SolvePlan(target, sweep, options), options.progress, options.kept);
}

}  // namespace raytube
