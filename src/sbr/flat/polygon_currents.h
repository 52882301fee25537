// What the currents on parts of faces radiate.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "math/chebyshev.h"
#include "sbr/beams/beam_tree.h"
#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/visible/beam_visibility.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

class PolygonCurrents {
 public:
  /// Keeps references to all it is given.
  PolygonCurrents(const TubeLook& look, BeamTree& beams, std::optional<PolygonLineOfSight>& line_of_sight)
      : look_(look), beams_(beams), line_of_sight_(line_of_sight), band_(look.wavenumbers()) {}

  /// Adds the PO integral over a part of a face, and over what of it the receiver has through sheets, as that of bounce `bounce`.
  /// `map`, if any, takes the currents as well.
  void add(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map);

 private:
  void radiate(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map);
  void radiate_spherical(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map);

  const TubeLook& look_;
  BeamTree& beams_;
  std::optional<PolygonLineOfSight>& line_of_sight_;
  Band band_;
  std::vector<Complex> integrals_;  // [frequency] of one part
};

}  // namespace raytube
