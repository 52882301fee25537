// sigma of the four channels as a picture.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Draws rcs.png and rcs.svg, and where polar_plot.h has one rcs_polar.png and rcs_polar.svg, in `folder`, which holds none of
/// them, with gnuplot. Returns an empty text, or why there is no picture: a plot is a convenience, so its absence is not an
/// error. Rows farther apart than the lobes of the target of these outermost points (scene/sampling.h) ask for are points without
/// a line between them, with median and band of sliding sectors (sliding_sector.h); without outermost points lines join all.
std::string plot_rcs(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep, const SweepResult& result,
                     std::span<const dvec3> outermost = {});

/// The gnuplot commands and data that draw `file`: maps of a sweep over two quantities (sweep_map.h), otherwise cuts. `terminal`
/// is "pngcairo" or "svg".
std::string rcs_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                            const SweepResult& result, std::span<const dvec3> outermost = {});

}  // namespace raytube
