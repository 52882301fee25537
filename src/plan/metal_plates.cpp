#include "plan/metal_plates.h"

#include <algorithm>

namespace raytube {

namespace {

bool has_bare_sides(const ThinPlateEdge& edge) {
  return edge.sides[0].material == no_index && edge.sides[1].material == no_index;
}

bool is_bare(const ThinPlateEdge& edge) { return has_bare_sides(edge) && edge.border_material == no_index; }

/// Of metal with a coat on a side; or rough there.
bool is_coated(const ThinPlateEdge& edge, std::span<const Material> materials) {
  const auto of_metal = [&](std::uint32_t material) {
    return material == no_index || materials[material].kind == MaterialKind::conductor ||
           materials[material].kind == MaterialKind::coated;
  };
  return !has_bare_sides(edge) && of_metal(edge.sides[0].material) && of_metal(edge.sides[1].material) &&
         of_metal(edge.border_material);
}

}  // namespace

std::vector<ThinPlateEdge> metal_plate_edges(std::span<const ThinPlateEdge> edges, std::span<const Material> materials,
                                             bool coats_count) {
  std::vector<ThinPlateEdge> found;
  for (const ThinPlateEdge& edge : edges) {
    if (!is_bare(edge) && !(coats_count && is_coated(edge, materials))) continue;
    found.push_back(edge);
    for (const WedgeFace& side : edge.sides)
      if (side.material != no_index) found.back().effective -= coat_depth(materials[side.material], 0);
    found.back().effective = std::max(found.back().effective, edge.thickness / 2);
  }
  sort_thinnest_first(found);
  return found;
}

}  // namespace raytube
