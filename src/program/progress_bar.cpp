#include "program/progress_bar.h"

#include <fmt/format.h>

#include <cstdio>

namespace raytube {

namespace {

std::string duration_text(double seconds) {
  const long whole = static_cast<long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

ProgressBar::ProgressBar(bool visible) : visible_(visible), start_(Clock::now()), last_(start_) {}

ProgressBar::~ProgressBar() {
  if (visible_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double share) {
  const Clock::time_point now = Clock::now();
  if (!visible_ || share <= 0.0 || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const int filled = static_cast<int>(40.0 * share);
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3.0f} %  {} left\033[K", "", filled, "", 40 - filled, 100.0 * share,
             duration_text(elapsed * (1.0 - share) / share));
  std::fflush(stderr);
}

void ProgressBar::note(const std::string& line) {
  if (visible_) fmt::print(stderr, "\r\033[K{}\n", line);
}

}  // namespace raytube
