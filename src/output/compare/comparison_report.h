// A comparison in words and numbers.
#pragma once

#include <filesystem>
#include <string>

#include "output/compare/comparison.h"

namespace raytube {

/// For the screen: what was compared, one column a channel, one line a measure.
std::string comparison_text(const Comparison& comparison);

/// For scripts: the same as one JSON document; a measure that does not exist is null.
std::string comparison_json(const Comparison& comparison);

/// Writes compare.csv: one row a channel; lines that begin with '#' say what was compared and how, `columns` (of the result and
/// of the reference, as the options have them) among it. Throws std::runtime_error if the disk does not take it.
void write_compare_csv(const std::filesystem::path& file, const Comparison& comparison,
                       const std::array<std::string, 2>& columns = {});

/// The channels whose rms error exceeds the tolerance, or that have a strong signal in the result alone: "vv 0.31 dB, vh inf dB".
/// Empty if there is none.
std::string above_tolerance(const Comparison& comparison, double tolerance_db);

}  // namespace raytube
