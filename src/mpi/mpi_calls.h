// How this room calls MPI: one thread at a time, and never waiting inside it.
#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

namespace raytube {

/// MPI is initialised for calls that do not overlap. It is one for the whole process.
inline std::mutex mpi_mutex;

/// Asks `done` until it says yes, without keeping a processor busy, and without being inside MPI for longer than one question.
/// Looks out in between.
template <class Done, class LookOut>
void wait_until(const Done& done, const LookOut& look_out) {
  using namespace std::chrono_literals;
  constexpr std::chrono::microseconds first_pause = 20us, longest_pause = 1000us;
  for (auto pause = first_pause;; pause = std::min(2 * pause, longest_pause)) {
    {
      const std::lock_guard lock(mpi_mutex);
      if (done()) return;
    }
    look_out();
    std::this_thread::sleep_for(pause);
  }
}

template <class Done>
void wait_until(const Done& done) {
  wait_until(done, [] {});
}

}  // namespace raytube
