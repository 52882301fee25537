#include "plan/material_edges.h"

#include "utd/fringe/material_edges.h"

namespace raytube {

MaterialEdgeCount count_material_edges(std::span<const Wedge> wedges, std::span<const Material> materials) {
  MaterialEdgeCount count;
  for (const Wedge& wedge : wedges) {
    if (!wedge.convex() || wedge.conducting()) continue;
    ++count.all;
    if (is_material_edge(wedge, materials)) ++count.known;
  }
  return count;
}

}  // namespace raytube
