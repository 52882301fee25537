// Ctrl-C: at once while nothing is at stake; during the computation at the next tile, and in any case within a second.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace raytube {

constexpr int code_of_an_interrupt = 130;

/// From now on Ctrl-C (or a termination request, which is no different) ends the program at once with a message and that code.
void end_on_interrupt();

/// While one lives, Ctrl-C only raises a flag, for the computation to end by itself. If that takes too long (nobody looks at the
/// flag inside a single edge or a library), `last_words` clears up from a thread of its own and says what is left, and the
/// program ends there; without a sentence, the program is done anyway and may go on. Another Ctrl-C two seconds later ends at
/// once.
class InterruptFlag {
 public:
  explicit InterruptFlag(std::function<std::optional<std::string>()> last_words);
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  static bool raised();

  /// The flag was seen between two files: from here on the way out is short, and must not be taken twice at a time.
  static void leaving();

 private:
  void watch(const std::stop_token& over);

  std::function<std::optional<std::string>()> last_words_;
  std::mutex mutex_;
  std::condition_variable_any over_;
  std::jthread watch_;
};

/// While one lives, nobody's last words end the program: results change places.
class NotNow {
 public:
  NotNow();
  ~NotNow();
  NotNow(const NotNow&) = delete;
  NotNow& operator=(const NotNow&) = delete;
};

}  // namespace raytube
