#include "program/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <ctime>

namespace raytube {

namespace {

volatile std::sig_atomic_t deferred = 0;
volatile std::sig_atomic_t flag = 0;
volatile std::sig_atomic_t must_clean_up = 0;
timespec raised_at;

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
    flag = 1;
    return;
  }
  if (deferred && must_clean_up) return;
  if (deferred && seconds_since(raised_at) < 1.0) return;  // shells and wrappers may deliver one Ctrl-C twice
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

InterruptFlag::InterruptFlag() {
  flag = 0;
  must_clean_up = 0;
  deferred = 1;
}

InterruptFlag::~InterruptFlag() { deferred = 0; }

bool InterruptFlag::raised() { return flag != 0; }

void InterruptFlag::clean_up_first() { must_clean_up = 1; }

}  // namespace raytube
