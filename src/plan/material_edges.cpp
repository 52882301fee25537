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

}  // namespace

MaterialEdgeCount count_material_edges(std::span<const Wedge> wedges, std::span<const Material> materials,
                                       std::span<const double> frequencies) {
  std::vector<bool> has_edges;
  for (const Material& material : materials) has_edges.push_back(!material.transmits() || has_rims(material, frequencies));
  MaterialEdgeCount count;
  for (const Wedge& wedge : wedges) {
    if (!wedge.convex() || wedge.conducting()) continue;
    ++count.all;
    const auto of_solid = [&](const WedgeFace& face) { return is_solid(materials, face.material); };
    count.of_solids += std::ranges::any_of(wedge.faces, of_solid);
    if (!is_material_edge(wedge, materials)) continue;
    if (!is_sheet_rim(wedge, materials) || has_edges[wedge.faces[0].material]) ++count.known;
  }
  return count;
}

}  // namespace raytube
