// sigma of the four channels as a picture.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Draws rcs.png and rcs.svg in `folder`, which holds neither, with gnuplot. Returns an empty text, or why there is no picture: a
/// plot is a convenience, so its absence is not an error. Rows farther apart than the lobes of the target of these outermost
/// points (scene/sampling.h) ask for are points without a line between them; without points lines join all.
std::string plot_rcs(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep, const SweepResult& result,
                     std::span<const dvec3> outermost = {});

/// The gnuplot commands and data that draw `file`; `terminal` is "pngcairo" or "svg".
std::string rcs_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                            const SweepResult& result, std::span<const dvec3> outermost = {});

}  // namespace raytube
