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
#include "solve/look_solver.h"

namespace raytube {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double least_seconds = 0.2;  // looks are timed again where all of them together take less [s]

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Cancels work that is not done in time.
class Deadline {
 public:
  Deadline(tbb::task_group_context& work, double seconds)
      : thread_([this, &work, seconds] {
          std::unique_lock lock(mutex_);
          if (!done_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return finished_; }))
            work.cancel_group_execution();
        }) {}
  ~Deadline() {
    {
      const std::lock_guard lock(mutex_);
      finished_ = true;
    }
    done_.notify_all();
    thread_.join();
  }
  Deadline(const Deadline&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool finished_ = false;
  std::thread thread_;
};

// The n-th of many looks such that the first ones lie far apart: steps of the golden ratio.
std::size_t spread(std::size_t n, std::size_t count) {
  const double place = std::fmod((static_cast<double>(n) + 0.5) * 0.6180339887498949, 1.0);
  return std::min(count - 1, static_cast<std::size_t>(place * static_cast<double>(count)));
}

class Probe {
 public:
  Probe(const SolvePlan& plan, const LookSolver& solver) : plan_(plan), solver_(solver) {}

  // Seconds that a batch of looks takes, side by side as in a solve; none if it was given up.
  std::optional<double> batch(std::size_t size, double patience) {
    tbb::task_group_context context;
    const auto start = Clock::now();
    {
      const Deadline deadline(context, patience);
      const auto solve = [&](std::size_t i) { tbb::this_task_arena::isolate([&] { solve_look(next_ + i); }); };
      try {
        tbb::parallel_for(std::size_t{0}, size, solve, context);
      } catch (const Interrupted&) {
        return {};
      }
    }
    if (context.is_group_execution_cancelled()) return {};
    next_ += size;
    return seconds_since(start);
  }

 private:
  void solve_look(std::size_t n) const {
    Progress none({});
    const std::size_t look = plan_.looks.computed[spread(n, plan_.looks.computed.size())];
    look_bytes(solver_.solve(look, none, 0.0));
    stop_if_cancelled();
  }

  const SolvePlan& plan_;
  const LookSolver& solver_;
  std::size_t next_ = 0;
};

// The first batch warms up: it counts only if there is no other.
TimePrediction timed_looks(const SolvePlan& plan, const LookSolver& solver, double seconds, double patience) {
  const std::size_t looks = plan.looks.computed.size(), threads = plan.threads > 0 ? plan.threads : all_threads();
  const std::size_t batch = std::min(looks, threads);
  Probe probe(plan, solver);
  const auto start = Clock::now();
  TimePrediction result;
  double sum = 0.0;
  const auto goes_on = [&](std::size_t done) {
    const double passed = seconds_since(start);
    return (done < looks && passed < seconds) || passed < least_seconds;
  };
  for (std::size_t done = 0; goes_on(done); done += batch) {
    const std::optional<double> took = probe.batch(batch, std::max(patience - seconds_since(start), seconds));
    if (!took) {
      result.at_least = result.looks == 0;
      if (result.at_least) sum = seconds_since(start), result.looks = batch;
      break;
    }
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

TimePrediction predict_time(const SolvePlan& plan, double seconds, double patience) {
  const auto start = Clock::now();
  const LookSolver solver(plan);
  const double setup = plan.seconds + seconds_since(start);
  TimePrediction result;
  run_on_threads(plan.threads, [&] { result = timed_looks(plan, solver, seconds, patience); });
  result.solve_s += setup;
  return result;
}

}  // namespace raytube
