// Impedances of the materials of a target that nothing goes through.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/features/wedges.h"
#include "utd/impedance/surface_impedance.h"

namespace raytube {

/// Nothing goes through either face of this wedge, and nothing comes back from inside.
bool is_opaque(const Wedge& wedge, std::span<const Material> materials);

/// At all frequencies of a sweep.
class ImpedanceTable {
 public:
  ImpedanceTable(std::span<const Material> materials, std::span<const double> frequencies);

  /// The entry of an edge of such materials, beside one that is no conductor.
  bool known(const Wedge& wedge) const;

  /// What the border face of a thin plate does to a wave that meets it at this cosine, at frequency number `frequency`; a
  /// conductor's where it is dark.
  SurfaceResponse at_border(const Wedge& wedge, std::size_t frequency, double wavenumber, double cosine) const;
  /// Whether that face is coated.
  bool border_coated(const Wedge& wedge) const {
    return wedge.border_material != no_index && materials_[wedge.border_material].kind == MaterialKind::coated;
  }

  /// The impedances of the faces of an opaque wedge, at frequency number `frequency`.
  std::array<SurfaceImpedance, 2> at(const Wedge& wedge, std::size_t frequency) const;

 private:
  std::span<const Material> materials_;
  std::vector<std::vector<SurfaceImpedance>> impedances_;  // [material][frequency]
};

}  // namespace raytube
