// sigma over two swept quantities: maps of the channels, and the two cuts through the peak.
#pragma once

#include <span>
#include <string>

#include "output/tables/sweep_map.h"

namespace raytube {

/// The gnuplot commands and data that draw `file`. Cross-polar channels have maps where they come within 20 dB of the peak; the
/// cuts show all four channels.
std::string map_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                            const SweepResult& result, const SweepMap& map, std::span<const dvec3> outermost);

}  // namespace raytube
