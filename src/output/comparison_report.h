// A comparison in words and numbers.
#pragma once

#include <filesystem>
#include <string>

#include "output/comparison.h"

namespace raytube {

/// For the screen: what was compared, one column a channel, one line a measure.
std::string comparison_text(const Comparison& comparison);

/// compare.csv: one row a channel; lines that begin with '#' say what was compared and how.
void write_compare_csv(const std::filesystem::path& file, const Comparison& comparison);

/// The channels with signal whose rms error exceeds the tolerance: "vv 0.31 dB, hh 0.12 dB"; empty if there is none.
std::string above_tolerance(const Comparison& comparison, double tolerance_db);

}  // namespace raytube
