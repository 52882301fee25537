// Pictures on request: results of any source as curves, maps or polar curves.
#pragma once

#include "output/charts/canvas.h"

namespace raytube {

/// Throws InputError if the results do not make a picture of this kind.
Chart made_chart(std::vector<ChartResult> results, const ChartOptions& options);

}  // namespace raytube
