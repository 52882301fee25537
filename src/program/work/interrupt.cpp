#include "program/work/interrupt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>

namespace raytube {

namespace {

using namespace std::chrono_literals;

constexpr auto look_out = 50ms;                       // interval between looks at the flag
constexpr auto patience = 500ms;                      // for a computation that is to end by itself
constexpr std::int64_t twice_within = 2'000'000'000;  // [ns] shells and wrappers may deliver one Ctrl-C twice

std::atomic<bool> deferred = false;
std::atomic<bool> on_the_way_out = false;
std::atomic<std::int64_t> raised_at = 0;  // [ns] of the steady clock; 0: not yet
static_assert(std::atomic<std::int64_t>::is_always_lock_free &&
              std::atomic<bool>::is_always_lock_free);  // signal handlers use them
std::mutex moving;                                      // held while results take their places

// Uses only what a signal handler may: clock_gettime, write, _exit and flags. Two threads may be in it at a time.
void on_signal(int) {
  static constexpr char sentence[] = "raytube: interrupted\n";
  timespec clock;
  clock_gettime(CLOCK_MONOTONIC, &clock);
  const std::int64_t now = std::int64_t{1'000'000'000} * clock.tv_sec + clock.tv_nsec;
  std::int64_t earlier = 0;
  if (deferred && raised_at.compare_exchange_strong(earlier, now)) return;
  if (deferred && now - earlier < twice_within) return;
  if (write(STDERR_FILENO, sentence, sizeof sentence - 1) < 0) _exit(code_of_an_interrupt);
  _exit(code_of_an_interrupt);
}

}  // namespace

void end_on_interrupt() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

InterruptFlag::InterruptFlag(std::function<std::optional<std::string>()> last_words) : last_words_(std::move(last_words)) {
  raised_at = 0;
  on_the_way_out = false;
  deferred = true;
  watch_ = std::jthread([this](const std::stop_token& over) { watch(over); });
}

InterruptFlag::~InterruptFlag() {
  watch_.request_stop();
  watch_.join();
  deferred = false;
}

bool InterruptFlag::raised() { return raised_at != 0; }

void InterruptFlag::leaving() { on_the_way_out = true; }

void InterruptFlag::watch(const std::stop_token& over) {
  const auto pause = [&](auto duration) {
    std::unique_lock lock(mutex_);
    over_.wait_for(lock, over, duration, [] { return false; });
  };
  while (!raised() && !over.stop_requested()) pause(look_out);
  pause(patience);
  while (on_the_way_out && !over.stop_requested()) pause(look_out);
  if (over.stop_requested()) return;
  const std::lock_guard not_while_results_move(moving);
  const std::optional<std::string> sentence = last_words_();
  if (!sentence) return;
  fmt::print(stderr, "{}raytube: {}\n", isatty(STDERR_FILENO) ? "\r\033[K" : "", *sentence);
  _exit(code_of_an_interrupt);
}

std::unique_lock<std::mutex> hold_last_words() { return std::unique_lock(moving); }

}  // namespace raytube
