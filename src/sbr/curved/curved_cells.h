// Tubes on curved surfaces: cells of the launch plane as large as one quadric describes what they meet.
//
// The central header of this folder. About a point x0 of a curved surface with normal n and curvature matrix C
//   n . X = X . C X / 2,   X = r - x0,
// which is a depth over the launch plane up to the surface's own shadow boundary, a conic (curved_piece). The PO integral over it
// is a quadrature along chords (curved_integral); which cells are one piece each is decided here. What a curved surface reflects
// goes on as narrow tubes with curved wavefronts (curved_beam), traced in curved_tubes.
#pragma once

#include <array>
#include <vector>

#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/curved/facing_triangles.h"

namespace raytube {

/// The first-bounce currents of the curved surfaces (look.smooth) of a look, block by block of the launch plane. A cell that one
/// quadric describes to within a fraction of a radian, whole or up to the surface's own shadow boundary, is one tube. Others are
/// split; where few facets are left, or the cell is small against the wavelength, exactly the visible part of each facet is a
/// tube. Every triangle over a cell takes part in that decision, so nothing is missed for its size.
class CurvedLook {
 public:
  static constexpr int across = 8;  // blocks along each side
  static constexpr std::size_t blocks = std::size_t{across} * across;

  /// Keeps a reference to `look`.
  explicit CurvedLook(const TubeLook& look);

  /// Integrates one block. Thread-safe.
  TubeSums trace(std::size_t block) const;

 private:
  struct Block {
    Bounds box;
    std::vector<std::uint32_t> triangles;  // in facing_
  };
  void fill_blocks();

  const TubeLook& look_;
  std::vector<FacingTriangle> facing_;
  std::vector<Block> blocks_;
};

}  // namespace raytube
