// How long work that goes on will still take.
#pragma once

#include <optional>

namespace raytube {

/// The rest at the rate so far. What was there when the work began does not count in the rate, nor does the time until it was
/// taken up.
class TimeLeft {
 public:
  /// `there`: the share (0 to 1) of all work that is done already.
  explicit TimeLeft(double there = 0.0) : there_(there) {}

  /// Seconds left, `seconds` after the start with this share done; none as long as no work shows a rate. To be called at every
  /// step forward.
  std::optional<double> after(double share, double seconds);

 private:
  double there_, begun_ = 0.0;
};

}  // namespace raytube
