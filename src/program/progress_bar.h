// A line on the terminal that shows how much is done and how long the rest will take.
#pragma once

#include <chrono>
#include <string>

namespace raytube {

class ProgressBar {
 public:
  explicit ProgressBar(bool visible);
  ~ProgressBar();  // leaves a clean line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(double share);

  /// A line that stays, above the bar.
  void note(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  bool visible_;
  Clock::time_point start_, last_;
};

}  // namespace raytube
