#include "program/work/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "program/work/interrupt.h"

namespace raytube {

ProgressBar::ProgressBar(bool quiet, const std::string& work, double done)
    : kind_(quiet                        ? Kind::none
            : isatty(STDERR_FILENO) != 0 ? Kind::bar
                                         : Kind::lines),
      start_(Clock::now()),
      last_(start_),
      left_(done) {
  if (kind_ == Kind::lines) fmt::print(stderr, "raytube: {}\n", work);
}

ProgressBar::~ProgressBar() {
  if (kind_ == Kind::bar) fmt::print(stderr, "\r\033[K");
}

bool ProgressBar::show(double share) {
  const Clock::time_point now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::optional<double> left = left_.after(share, elapsed);
  if (kind_ != Kind::none && left && now - last_ >= std::chrono::milliseconds(100)) {
    last_ = now;
    if (kind_ == Kind::bar)
      draw(share, *left);
    else if (const auto line = lines_.due(share, elapsed, *left))
      fmt::print(stderr, "raytube: {}\n", *line);
  }
  return !InterruptFlag::raised();
}

void ProgressBar::draw(double share, double left) const {
  const int filled = static_cast<int>(40.0 * share);
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3.0f} %  {} left\033[K", "", filled, "", 40 - filled, 100.0 * share,
             duration_text(left));
  std::fflush(stderr);
}

void ProgressBar::note(const std::string& line) {
  if (kind_ == Kind::bar) fmt::print(stderr, "\r\033[K{}\n", line);
}

}  // namespace raytube
