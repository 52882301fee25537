// A study over tube density in words and numbers.
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

/// Writes converge.csv: one row a density; lines that begin with '#' hold what concerns all of them. Throws std::runtime_error if
/// the disk does not take it.
void write_converge_csv(const std::filesystem::path& file, const ConvergenceStudy& study);

}  // namespace raytube
