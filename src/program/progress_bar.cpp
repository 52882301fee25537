#include "program/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace raytube {

namespace {

void tell(const std::string& line) { fmt::print(stderr, "raytube: {}\n", line); }

}  // namespace

ProgressBar::ProgressBar(bool quiet, const std::string& work)
    : kind_(quiet                        ? Kind::none
            : isatty(STDERR_FILENO) != 0 ? Kind::bar
                                         : Kind::lines),
      start_(Clock::now()),
      last_(start_) {
  if (kind_ == Kind::lines) tell(work);
}

ProgressBar::~ProgressBar() {
  if (kind_ == Kind::bar) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double share) {
  const Clock::time_point now = Clock::now();
  if (kind_ == Kind::none || share <= 0.0 || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (kind_ == Kind::bar) return draw(share, elapsed);
  if (const auto line = lines_.due(share, elapsed)) tell(*line);
}

void ProgressBar::draw(double share, double elapsed) const {
  const int filled = static_cast<int>(40.0 * share);
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3.0f} %  {} left\033[K", "", filled, "", 40 - filled, 100.0 * share,
             duration_text(elapsed * (1.0 - share) / share));
  std::fflush(stderr);
}

void ProgressBar::note(const std::string& line) {
  if (kind_ == Kind::bar) fmt::print(stderr, "\r\033[K{}\n", line);
}

}  // namespace raytube
