// What a run on random tubes gives beside the deterministic solution of the same case: plain data only.
#pragma once

#include <array>

#include "scene/results.h"

namespace raytube {

/// Tubes at random places, in the place of a grid.
struct RandomOptions {
  std::uint64_t samples = 100000;  // tubes a look and run, at least 1
  std::uint64_t seed = 1;          // the same seed gives the same bytes
  int runs = 10;                   // independent ones, at least 2
};

/// How single runs scatter about their mean, in one channel of one row.
struct ChannelSpread {
  double amplitude;  // standard deviation of complex S: root of sum |S - mean|^2 / (runs - 1) [m]
  double db;         // standard deviation of the level; not finite where a run gave exactly zero
  double bias_db;    // mean of the levels minus the deterministic level; not finite where one of them is zero
};
using RowSpread = std::array<std::array<ChannelSpread, 2>, 2>;  // [receive][transmit]

/// How random tubes scatter about the deterministic answer.
struct RandomResult {
  RandomOptions options;  // that it was computed with
  SweepResult
      mean;  // of the runs; its errors are the standard errors of complex S [m]; its statistics count the tubes of all runs
  SweepResult deterministic;      // of the same target and sweep
  std::vector<RowSpread> spread;  // [row]
  double run_s = 0.0;             // time of one run
};

}  // namespace raytube
