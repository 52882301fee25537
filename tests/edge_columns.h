// What all mechanisms of edges but edge-face interaction add to a result.
#pragma once

#include "scene/results.h"

namespace raytube::test {

/// Their S, by row [m].
inline std::vector<ScatteringMatrix> of_edges(const SweepResult& result) {
  std::vector<ScatteringMatrix> sum(result.total.size());
  for (const char* column : {"edges_order_1", "edges_order_2_on", "material_edges_order_1", "material_edges_order_2_on",
                             "plate_corners", "thin_ends", "solid_corners"}) {
    const std::vector<ScatteringMatrix>& part = result.of(column);
    for (std::size_t row = 0; row < part.size(); ++row) sum[row] += part[row];
  }
  return sum;
}

}  // namespace raytube::test
