// Ctrl-C ends the program at once while nothing is at stake, and a computation at its next tile, within a second in any case.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace raytube {

constexpr int code_of_an_interrupt = 130;

/// From now on Ctrl-C, or a request to terminate, ends the program at once with a message and code_of_an_interrupt.
void end_on_interrupt();

/// While one exists, Ctrl-C only raises a flag, so that the computation ends by itself. If that takes too long (nothing looks at
/// the flag within a single edge or a library), `last_words` cleans up in a thread of its own, its sentence is printed, and the
/// program ends; without a sentence the work is complete, and the program goes on. Another Ctrl-C two seconds later ends the
/// program at once.
class InterruptFlag {
 public:
  explicit InterruptFlag(std::function<std::optional<std::string>()> last_words);
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  static bool raised();

  /// The flag was seen between two files: the work ends soon by itself, and last words must not interfere.
  static void leaving();

 private:
  void watch(const std::stop_token& over);

  std::function<std::optional<std::string>()> last_words_;
  std::mutex mutex_;
  std::condition_variable_any over_;
  std::jthread watch_;
};

/// While it is held, no last words end the program: results change places.
std::unique_lock<std::mutex> hold_last_words();

}  // namespace raytube
