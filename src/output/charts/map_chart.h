// sigma over two quantities as colours.
#pragma once

#include "output/charts/canvas.h"
#include "output/tables/sweep_map.h"

namespace raytube {

/// The grid through the result's peak, with azimuth across; none if its rows hold none with more than `most_cuts` cuts.
std::optional<SweepMap> chart_map(const ChartResult& result, std::size_t most_cuts);

/// Of channels that nobody asked for, those that deserve a map: cross-polar ones within 20 dB of the peak.
std::vector<std::size_t> channels_with_maps(const ChartResult& result, std::vector<std::size_t> channels);

/// Directions all round the target are projected onto a plane (sphere_map.h); windows of them are drawn in their true form in
/// the middle, and all else over plain axes.
Chart map_chart(const ChartResult& result, const SweepMap& map, const std::vector<std::size_t>& channels,
                const ChartOptions& options);

}  // namespace raytube
