// Random runs beside the deterministic solution: table, comment for rcs.csv and a summary for the terminal.
#pragma once

#include <filesystem>
#include <string>

#include "scene/random_result.h"
#include "scene/sweep.h"

namespace raytube {

/// All rows and channels in one figure each; amplitudes as the root of a sum of squares over both.
struct RandomSummary {
  double spread;               // of one run, relative to the solution
  double bias, expected_bias;  // of the mean, relative to the solution; and what chance alone leaves of it
  double spread_db, bias_db;   // of the levels: rms and mean over what lies within 20 dB of the highest level of the solution
};
/// The figures of all runs against the deterministic solution.
RandomSummary summarise(const RandomResult& result);

/// Writes random.csv: one row per look, frequency and channel, with mean, spread, standard error and bias of S and of its level.
void write_random_csv(const std::filesystem::path& file, const Sweep& sweep, const RandomResult& result);

/// A comment line for rcs.csv that says what its values are: means of random runs.
std::string random_note(const RandomOptions& options);

/// The summary as lines for the terminal.
std::string random_text(const RandomResult& result);

}  // namespace raytube
