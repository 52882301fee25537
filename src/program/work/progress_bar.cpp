#include "program/work/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "core/threads.h"

namespace raytube {

namespace {

void tell(const std::string& line) { fmt::print(stderr, "raytube: {}\n", line); }

}  // namespace

std::string work_text(const SolvePlan& plan) {
  const std::size_t looks = plan.looks.computed.size(), frequencies = plan.sweep.frequencies.size();
  const int threads = plan.threads > 0 ? plan.threads : all_threads();
  return fmt::format("solving {} look{} at {} frequenc{} on {} thread{}", looks, looks == 1 ? "" : "s", frequencies,
                     frequencies == 1 ? "y" : "ies", threads, threads == 1 ? "" : "s");
}

ProgressBar::ProgressBar(bool quiet, const std::string& work, double there)
    : kind_(quiet                        ? Kind::none
            : isatty(STDERR_FILENO) != 0 ? Kind::bar
                                         : Kind::lines),
      start_(Clock::now()),
      last_(start_),
      left_(there) {
  if (kind_ == Kind::lines) tell(work);
}

ProgressBar::~ProgressBar() {
  if (kind_ == Kind::bar) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double share) {
  const Clock::time_point now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::optional<double> left = left_.after(share, elapsed);
  if (kind_ == Kind::none || !left || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  if (kind_ == Kind::bar) return draw(share, *left);
  if (const auto line = lines_.due(share, elapsed, *left)) tell(*line);
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
