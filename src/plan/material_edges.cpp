#include "plan/material_edges.h"

#include <algorithm>

#include "utd/fringe/material_edges.h"

namespace raytube {

namespace {

// Rims of a material that lets waves through: too thick a plate has none.
bool has_rims(const Material& material, std::span<const double> frequencies) {
  for (std::size_t f = 0; f < frequencies.size(); ++f)
    if (sheet_share(material, f, wavenumber(frequencies[f])) > 0.0) return true;
  return false;
}

bool has_bare_sides(const ThinPlateEdge& edge) {
  return edge.sides[0].material == no_index && edge.sides[1].material == no_index;
}

bool is_bare(const ThinPlateEdge& edge) { return has_bare_sides(edge) && edge.border_material == no_index; }

// Of metal with a coat on a side; or rough there.
bool is_coated(const ThinPlateEdge& edge, std::span<const Material> materials) {
  const auto of_metal = [&](std::uint32_t material) {
    return material == no_index || materials[material].kind == MaterialKind::conductor ||
           materials[material].kind == MaterialKind::coated;
  };
  return !has_bare_sides(edge) && of_metal(edge.sides[0].material) && of_metal(edge.sides[1].material) &&
         of_metal(edge.border_material);
}

}  // namespace

MaterialEdgeCount count_material_edges(const Target& target, const Sweep& sweep, const EdgeOptions& asked) {
  const std::vector<Material>& materials = sweep.materials;
  std::vector<bool> has_edges;
  for (const Material& material : materials) has_edges.push_back(!material.transmits() || has_rims(material, sweep.frequencies));
  MaterialEdgeCount count;
  for (const Wedge& wedge : target.wedges) {
    if (!wedge.convex() || wedge.conducting()) continue;
    ++count.all;
    const auto of_solid = [&](const WedgeFace& face) { return is_solid(materials, face.material); };
    count.of_solids += std::ranges::any_of(wedge.faces, of_solid);
    if (!is_material_edge(wedge, materials)) continue;
    if (!is_sheet_rim(wedge, materials) || has_edges[wedge.faces[0].material]) ++count.known;
  }
  if (asked.method == EdgeMethod::fringe && asked.materials == MaterialEdgeMethod::fringe) count.computed = count.known;
  return count;
}

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
