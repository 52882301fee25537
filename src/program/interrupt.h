// Ctrl-C: at once while nothing is at stake, at the next tile during the computation, at the next file while results are written.
#pragma once

namespace raytube {

/// From now on Ctrl-C (or a termination request) ends the program at once with a message and code 130 (143).
void end_on_interrupt();

/// While one lives, Ctrl-C only raises a flag, so that results are either complete or absent; another one a second later
/// ends at once.
class InterruptFlag {
 public:
  InterruptFlag();
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  static bool raised();

  /// From now on a second one does not end the program at once either: what is written has to be cleaned up first.
  static void clean_up_first();
};

}  // namespace raytube
