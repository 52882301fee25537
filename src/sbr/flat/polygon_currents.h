// What the currents on parts of faces radiate.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sbr/beams/beam_tree.h"
#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/launch/lattice.h"
#include "sbr/visible/beam_visibility.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

std::uint64_t cells_of(std::span<const CellBlock> blocks);

class PolygonCurrents {
 public:
  /// Keeps references to all it is given.
  PolygonCurrents(const TubeLook& look, BeamTree& beams, std::optional<PolygonLineOfSight>& line_of_sight)
      : look_(look), beams_(beams), line_of_sight_(line_of_sight), band_(look.wavenumbers()) {}

  /// Adds the PO integral over a part of a face, and over what of it the receiver has through sheets, as that of bounce `bounce`;
  /// `blocks` are the cells that stand for it where tubes are not clipped. `map`, if any, takes the currents as well.
  void add(TubeSums& to, std::uint32_t node, const VisiblePart& part, std::span<const CellBlock> blocks, int bounce,
           CurrentMap* map);

 private:
  void add_spherical(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map);
  void add_spherical_part(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map) const;
  void add_to_estimates(TubeSums& to, const Footprint& footprint, const ConvexPolygon& outline,
                        std::span<const CellBlock> blocks) const;
  void add_to_map(CurrentMap& map, const Footprint& footprint, const VisiblePart& part, std::span<const CellBlock> blocks) const;
  void count_staircase(TubeSums& to, const Footprint& footprint, const ConvexPolygon& outline) const;
  Complex over_cells(const Footprint& footprint, double k, std::span<const CellBlock> blocks) const;

  const TubeLook& look_;
  BeamTree& beams_;
  std::optional<PolygonLineOfSight>& line_of_sight_;
  Band band_;
  std::vector<Complex> integrals_;  // [frequency] of one part
  std::vector<CellBlock> screened_blocks_;
};

}  // namespace raytube
