// A comparison as a picture: both results over the swept quantity, their difference below.
#pragma once

#include <filesystem>
#include <string>

#include "output/compare/comparison.h"

namespace raytube {

/// Draws compare.png and compare.svg in `folder`, which holds neither. Returns an empty text, or why there is no picture.
std::string plot_comparison(const std::filesystem::path& folder, const Comparison& comparison);

/// The gnuplot commands and data that draw `file`; `terminal` is "pngcairo" or "svg".
std::string comparison_plot_script(const std::string& terminal, const std::string& file, const Comparison& comparison);

}  // namespace raytube
