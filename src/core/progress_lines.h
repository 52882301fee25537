// When to say how far a long computation is, and in which words, where there is no terminal to draw a bar on.
#pragma once

#include <optional>
#include <string>

namespace raytube {

/// "42 s", "3 min 05 s", "2 h 07 min".
std::string duration_text(double seconds);

/// A line whenever ten per cent more are done, but no sooner than 30 s after the last one.
class ProgressLines {
 public:
  /// The line due now, `seconds` after the start with this share (0 to 1) of the work done and so many seconds left; none if none
  /// is, nor at the end.
  std::optional<std::string> due(double share, double seconds, double left);

 private:
  int last_tenth_ = 0;
  double last_seconds_ = 0.0;
};

}  // namespace raytube
