// sigma all round the target, over azimuth as an angle.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Whether any cut of the sweep over azimuth goes all round (output/tables/sliding_sector.h).
bool has_full_circle(const Sweep& sweep);

/// The gnuplot commands and data that draw `file`: the cut over azimuth through the peak. Nothing if that does not go all round.
std::optional<std::string> polar_plot_script(const std::string& terminal, const std::string& file, const std::string& title,
                                             const Sweep& sweep, const SweepResult& result, std::span<const dvec3> outermost);

}  // namespace raytube
