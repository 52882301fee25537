// How much is done and how long the rest will take, on stderr: a bar on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <string>

#include "core/progress_lines.h"
#include "core/time_left.h"

namespace raytube {

class ProgressBar {
 public:
  /// `work` describes the work in one line, printed at the start where there is no terminal; `done` is the share of it that is
  /// done already. Shows nothing if `quiet`.
  ProgressBar(bool quiet, const std::string& work, double done = 0.0);
  ~ProgressBar();  // leaves a clean line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Returns false once Ctrl-C was pressed: the computation is to stop.
  bool show(double share);

  /// Prints a line that stays above the bar.
  void note(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Kind { none, lines, bar };

  void draw(double share, double left) const;

  Kind kind_;
  Clock::time_point start_, last_;
  TimeLeft left_;
  ProgressLines lines_;
};

}  // namespace raytube
