// A comparison of images in words and numbers.
#pragma once

#include <filesystem>
#include <string>

#include "output/image_compare/image_comparison.h"

namespace raytube {

/// For the screen: what was compared, one column a channel, one line a measure.
std::string comparison_text(const ImageComparison& comparison);

/// Writes compare.csv: one row a channel. Throws std::runtime_error if the disk does not take it.
void write_compare_csv(const std::filesystem::path& file, const ImageComparison& comparison);

/// As of tables.
std::string above_tolerance(const ImageComparison& comparison, double tolerance_db);

}  // namespace raytube
