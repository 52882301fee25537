// Ctrl-C: at once while nothing is being written, at the next tile during the computation.
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
};

}  // namespace raytube
