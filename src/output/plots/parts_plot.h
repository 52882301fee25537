// sigma by mechanism as a picture.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Draws parts.png and parts.svg in `folder`, which holds neither: VV and HH of the cut through the peak, all mechanisms together
/// and each alone; points and outermost points as in plot_rcs. Needs a result with parts. Returns an empty text, or why there is
/// no picture.
std::string plot_parts(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep,
                       const SweepResult& result, std::span<const dvec3> outermost);

/// The gnuplot commands and data that draw `file`, as rcs_plot_script.
std::string parts_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                              const SweepResult& result, std::span<const dvec3> outermost);

}  // namespace raytube
