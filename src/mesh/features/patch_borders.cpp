#include "mesh/features/patch_borders.h"

#include <algorithm>

namespace raytube {

PatchBorders::PatchBorders(const TriangleMesh& mesh, const EdgeTable& edges) : borders_(mesh.patches.size()) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [low, high, sides] = edges[e];
    const auto patch = [&](const EdgeTable::Side& side) { return mesh.triangle_patch[side.triangle]; };
    if (sides.size() == 2 && patch(sides[0]) == patch(sides[1])) continue;
    for (const EdgeTable::Side& side : sides) borders_[patch(side)].insert(borders_[patch(side)].end(), {low, high});
  }
  for (auto& vertices : borders_) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
}

}  // namespace raytube
