#include "program/interrupt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>

namespace raytube {

namespace {

using namespace std::chrono_literals;

constexpr auto look_out = 50ms;   // for the flag
constexpr auto patience = 500ms;  // with a computation that should end by itself

std::atomic<bool> deferred = false;
std::atomic<bool> on_the_way_out = false;
std::atomic<int> flag = 0;                             // the signal
static_assert(std::atomic<int>::is_always_lock_free);  // else no signal handler may touch it
timespec raised_at;
std::mutex moving;  // of results into their place

double seconds_since(const timespec& earlier) {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - earlier.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - earlier.tv_nsec);
}

// Only what is allowed in a signal handler: clock_gettime, write, _exit and flags.
void on_signal(int signal) {
  static constexpr char sentence[] = "raytube: interrupted\n";
  if (deferred && !flag) {
    clock_gettime(CLOCK_MONOTONIC, &raised_at);
    flag = signal;
    return;
  }
  if (deferred && seconds_since(raised_at) < 2.0) return;  // shells and wrappers may deliver one Ctrl-C twice
  if (write(STDERR_FILENO, sentence, sizeof sentence - 1) < 0) _exit(128 + signal);
  _exit(128 + signal);
}

}  // namespace

void end_on_interrupt() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

InterruptFlag::InterruptFlag(std::function<std::optional<std::string>()> last_words) : last_words_(std::move(last_words)) {
  flag = 0;
  on_the_way_out = false;
  deferred = true;
  watch_ = std::jthread([this](const std::stop_token& over) { watch(over); });
}

InterruptFlag::~InterruptFlag() {
  watch_.request_stop();
  watch_.join();
  deferred = false;
}

bool InterruptFlag::raised() { return flag != 0; }

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
  _exit(128 + flag);
}

NotNow::NotNow() { moving.lock(); }
NotNow::~NotNow() { moving.unlock(); }

}  // namespace raytube
