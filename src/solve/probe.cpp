#include "solve/probe.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "core/threads.h"
#include "plan/admissible.h"
#include "solve/look_solver.h"

namespace raytube {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double share_rounding = 1e-9;  // of a share that is a sum of many
constexpr double least_seconds = 0.2;    // looks are timed again where all of them together take less [s]

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Cancels work that is not done in time.
class Deadline {
 public:
  Deadline(tbb::task_group_context& work, double seconds)
      : thread_([&work, seconds](const std::stop_token& done) {
          std::mutex mutex;
          std::unique_lock lock(mutex);
          std::condition_variable_any().wait_for(lock, done, std::chrono::duration<double>(seconds), [] { return false; });
          if (!done.stop_requested()) work.cancel_group_execution();
        }) {}

 private:
  std::jthread thread_;  // stopped and joined at the end
};

// The n-th of many looks such that the first ones lie far apart: steps of the golden ratio.
std::size_t spread(std::size_t n, std::size_t count) {
  const double place = std::fmod((static_cast<double>(n) + 0.5) * 0.6180339887498949, 1.0);
  return std::min(count - 1, static_cast<std::size_t>(place * static_cast<double>(count)));
}

// The same looks, tubes at once as dense as may be, without mechanisms that have a budget.
SolvePlan bounded_part(const SolvePlan& plan) {
  SolvePlan part = plan;
  for (std::size_t i = 0; i < part.mechanisms.size(); ++i)
    if (part.mechanisms[i].budget) part.states[i] = without("its budget bounds its time");
  if (!plan.tubes.refines()) return part;
  const double densest = densest_tubes(plan.target.mesh, plan.sweep, plan.tubes);
  part.tubes.per_wavelength = std::max(first_density(plan.tubes), std::min(plan.tubes.max_per_wavelength, 0.9 * densest));
  part.tubes.max_per_wavelength = part.tubes.per_wavelength;
  return part;
}

// Whether a look with this share of its progress has come to a mechanism in the last band.
bool has_begun(std::size_t mechanism, double share, const SolvePlan& plan) {
  return 1.0 - share <= share_left(plan, mechanism) / static_cast<double>(plan.bands.size()) + share_rounding;
}

void time_look(const SolvePlan& plan, const LookSolver& solver, std::size_t n, LookSoFar& so_far) {
  const auto start = Clock::now();
  Progress progress([&](double share) {
    so_far.passed_s = seconds_since(start);
    const double of_tubes = share / first_tubes_share;
    if (of_tubes <= 1.0 + share_rounding) so_far.share = of_tubes, so_far.share_s = so_far.passed_s;
    if (!so_far.tubes_s && has_begun(0, share, plan)) so_far.tubes_s = so_far.passed_s;
    for (std::size_t i = 0; i < plan.mechanisms.size() && !so_far.edges_s; ++i)
      if (plan.mechanisms[i].budget && has_begun(i, share, plan)) so_far.edges_s = so_far.passed_s;
    return true;
  });
  try {
    look_bytes(solver.solve(plan.looks.computed[spread(n, plan.looks.computed.size())], progress, 1.0));
  } catch (const Interrupted&) {
    so_far.passed_s = seconds_since(start);
    throw;
  }
  stop_if_cancelled();
}

struct Batch {
  std::optional<double> seconds;  // that its looks took, side by side as in a solve; none: they were given up
  std::vector<LookSoFar> looks;
};

Batch time_batch(const SolvePlan& plan, const LookSolver& solver, std::size_t first, std::size_t size, double patience) {
  Batch batch{{}, std::vector<LookSoFar>(size)};
  tbb::task_group_context context;
  const auto start = Clock::now();
  const auto look = [&](std::size_t i) {
    tbb::this_task_arena::isolate([&] { time_look(plan, solver, first + i, batch.looks[i]); });
  };
  try {
    const Deadline deadline(context, patience);
    tbb::parallel_for(std::size_t{0}, size, look, context);
  } catch (const Interrupted&) {
    return batch;
  }
  if (!context.is_group_execution_cancelled()) batch.seconds = seconds_since(start);
  return batch;
}

// For looks that were not done: from those of their parts whose time is known or bounded.
TimePrediction bound(const SolvePlan& plan, double patience, std::size_t size, double least_look_s) {
  const SolvePlan part = bounded_part(plan);
  const Batch batch = time_batch(part, LookSolver(part), 0, size, patience);
  double look_s = least_look_s;
  for (const LookSoFar& look : batch.looks) look_s = std::max(look_s, longest_look(look, plan));
  const auto batches = static_cast<double>((plan.looks.computed.size() + size - 1) / size);
  return {look_s * batches, look_s, size, true, std::max(least_look_s, batch.seconds.value_or(0.0)) * batches};
}

// The first batch warms up: it counts only if there is no other.
TimePrediction timed_looks(const SolvePlan& plan, const LookSolver& solver, double seconds, double patience) {
  const std::size_t looks = plan.looks.computed.size(), threads = plan.threads > 0 ? plan.threads : all_threads();
  const std::size_t batch = std::min(looks, threads);
  const auto start = Clock::now();
  TimePrediction result;
  double sum = 0.0;
  const auto goes_on = [&](std::size_t done) {
    const double passed = seconds_since(start);
    return (done < looks && passed < seconds) || passed < least_seconds;
  };
  for (std::size_t done = 0; goes_on(done); done += batch) {
    const std::optional<double> took =
        time_batch(plan, solver, done, batch, std::max(patience - seconds_since(start), seconds)).seconds;
    if (!took && result.looks == 0) return bound(plan, patience, batch, seconds_since(start));
    if (!took) break;
    if (done == batch) sum = 0.0, result.looks = 0;
    sum += *took;
    result.looks += batch;
  }
  const double each = sum / static_cast<double>(result.looks);
  result.solve_s = each * static_cast<double>(looks);
  result.look_s = each * static_cast<double>(batch);
  return result;
}

}  // namespace

double longest_look(const LookSoFar& look, const SolvePlan& plan) {
  constexpr double least_share = 0.01, unknown_edges = 30.0, least_growth = 1.5;
  const double all_passes = plan.tubes.refines() ? 1.0 / (1.0 - 1.0 / (least_growth * least_growth)) : 1.0;
  const double so_far = look.share > 0.0 ? look.share_s / std::min(look.share, 1.0) : look.passed_s / least_share;
  const double pass = look.tubes_s.value_or(std::max(look.passed_s, so_far));
  const double begun = look.tubes_s ? std::max(0.1 * pass, look.passed_s - pass) : pass;
  const double edges = look.edges_s ? *look.edges_s - pass : unknown_edges * begun;
  double budget = 0.0;
  for (std::size_t i = 0; i < plan.mechanisms.size(); ++i)
    if (plan.states[i].on && plan.mechanisms[i].budget) budget += plan.mechanisms[i].budget(plan);
  return (all_passes * pass + edges) * (1.0 + budget);
}

TimePrediction predict_time(const SolvePlan& plan, double seconds, double patience) {
  const auto start = Clock::now();
  const LookSolver solver(plan);
  const double setup = plan.seconds + seconds_since(start);
  TimePrediction result;
  run_on_threads(plan.threads, [&] { result = timed_looks(plan, solver, seconds, patience); });
  result.solve_s += setup;
  result.least_s += setup;
  return result;
}

}  // namespace raytube
