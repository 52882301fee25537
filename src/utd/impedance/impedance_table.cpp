#include "utd/impedance/impedance_table.h"

#include <algorithm>

namespace raytube {

bool is_opaque(const Wedge& wedge, std::span<const Material> materials) {
  return std::ranges::none_of(wedge.faces, [&](const WedgeFace& face) {
    if (face.material == no_index) return false;
    const Material& material = materials[face.material];
    return material.transmits() || material.kind == MaterialKind::solid;
  });
}

ImpedanceTable::ImpedanceTable(std::span<const Material> materials, std::span<const double> frequencies) : materials_(materials) {
  for (const Material& material : materials) {
    std::vector<SurfaceImpedance>& impedances = impedances_.emplace_back(frequencies.size());
    for (std::size_t f = 0; f < frequencies.size() && !material.transmits(); ++f)
      impedances[f] = surface_impedance(material, f, wavenumber(frequencies[f]));
  }
}

bool ImpedanceTable::known(const Wedge& wedge) const {
  return wedge.stands_alone() && !wedge.enclosed && !wedge.conducting() && is_opaque(wedge, materials_);
}

SurfaceResponse ImpedanceTable::at_border(const Wedge& wedge, std::size_t frequency, double wavenumber, double cosine) const {
  if (wedge.border_material == no_index || cosine <= 0.0) return perfect_conductor;
  return response(materials_[wedge.border_material], frequency, wavenumber, cosine, false);
}

std::array<SurfaceImpedance, 2> ImpedanceTable::at(const Wedge& wedge, std::size_t frequency) const {
  const auto of = [&](const WedgeFace& face) {
    return face.material == no_index ? SurfaceImpedance{} : impedances_[face.material][frequency];
  };
  return {of(wedge.faces[0]), of(wedge.faces[1])};
}

}  // namespace raytube
