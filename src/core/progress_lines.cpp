#include "core/progress_lines.h"

#include <fmt/format.h>

#include <cmath>

namespace raytube {

namespace {

constexpr double seconds_between_lines = 30.0;

}  // namespace

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::optional<std::string> ProgressLines::due(double share, double seconds, double left) {
  const int tenth = static_cast<int>(10.0 * share);
  if (tenth <= last_tenth_ || share >= 1.0 || seconds - last_seconds_ < seconds_between_lines) return {};
  last_tenth_ = tenth;
  last_seconds_ = seconds;
  return fmt::format("{:.0f} % after {}, about {} left", std::floor(100.0 * share), duration_text(seconds), duration_text(left));
}

}  // namespace raytube
