// How much is done and how long the rest will take, on stderr: a bar on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <string>

#include "core/progress_lines.h"

namespace raytube {

class ProgressBar {
 public:
  /// `work` says in a line at the start, where there is no terminal, what will be done. Shows nothing if `quiet`.
  ProgressBar(bool quiet, const std::string& work);
  ~ProgressBar();  // leaves a clean line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(double share);

  /// A line that stays, above the bar.
  void note(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Kind { none, lines, bar };

  void draw(double share, double elapsed) const;

  Kind kind_;
  Clock::time_point start_, last_;
  ProgressLines lines_;
};

}  // namespace raytube
