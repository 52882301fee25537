// The distribution of sigma as a picture.
#pragma once

#include <filesystem>
#include <string>

#include "output/statistics/statistics_tables.h"

namespace raytube {

/// Draws statistics.png and statistics.svg in `folder`, which holds neither: a histogram for each channel with the fitted laws.
/// Returns an empty text, or why there is no picture.
std::string plot_statistics(const std::filesystem::path& folder, const SigmaStatistics& statistics);

/// The gnuplot commands and data that draw `file`; `terminal` is "pngcairo" or "svg".
std::string statistics_plot_script(const std::string& terminal, const std::string& file, const SigmaStatistics& statistics);

}  // namespace raytube
