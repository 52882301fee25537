// A study over tube density in words, numbers and a picture.
#pragma once

#include <filesystem>
#include <string>

#include "output/compare/convergence.h"

namespace raytube {

/// What was solved and what it says.
struct ConvergenceStudy {
  std::string title;
  const Sweep& sweep;
  std::vector<DensityResult> results;  // from coarse to fine
  Convergence convergence;             // of these results
};

/// For the screen: one line a density, then order, extrapolated value and recommendation.
std::string convergence_text(const ConvergenceStudy& study);

/// converge.csv: one row a density; lines that begin with '#' hold what concerns all of them.
void write_converge_csv(const std::filesystem::path& file, const ConvergenceStudy& study);

/// Draws converge.png and converge.svg in `folder`, which holds neither: estimated error against density and against time.
/// Returns an empty text, or why there is no picture.
std::string plot_convergence(const std::filesystem::path& folder, const ConvergenceStudy& study);

/// The gnuplot commands and data that draw `file`; `terminal` is "pngcairo" or "svg".
std::string convergence_plot_script(const std::string& terminal, const std::string& file, const ConvergenceStudy& study);

}  // namespace raytube
