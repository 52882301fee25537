// A study over tube density as a picture.
#pragma once

#include <filesystem>
#include <string>

#include "output/compare/convergence_report.h"

namespace raytube {

/// Draws converge.png and converge.svg in `folder`, which holds neither: estimated error against density and against time.
/// Returns an empty text, or why there is no picture.
std::string plot_convergence(const std::filesystem::path& folder, const ConvergenceStudy& study);

/// The gnuplot commands and data that draw `file`; `terminal` is "pngcairo" or "svg".
std::string convergence_plot_script(const std::string& terminal, const std::string& file, const ConvergenceStudy& study);

}  // namespace raytube
