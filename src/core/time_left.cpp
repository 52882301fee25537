#include "core/time_left.h"

namespace raytube {

namespace {

constexpr double rounding = 1e-9;  // of a share that is a sum of many

}  // namespace

std::optional<double> TimeLeft::after(double share, double seconds) {
  if (share <= there_ + rounding) {
    begun_ = seconds;
    return {};
  }
  return (seconds - begun_) * (1.0 - share) / (share - there_);
}

}  // namespace raytube
