// Curves over an angle, drawn round.
#pragma once

#include "output/charts/canvas.h"

namespace raytube {

/// The cut through the first result's peak, or the one that all share. Throws InputError for sweeps over something else.
Chart polar_chart(const std::vector<ChartResult>& results, const std::vector<std::size_t>& channels, const ChartOptions& options);

}  // namespace raytube
