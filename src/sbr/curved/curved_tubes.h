// What curved surfaces reflect: narrow tubes whose wavefronts are curved.
#pragma once

#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"

namespace raytube {

/// The second and later bounces of the tubes that the curved surfaces (look.smooth) of a look reflect, block by block of the
/// launch plane. The tubes are those of the cells of the launch grid. Rays half a wavelength apart first find out where a
/// reflected tube meets anything; only there, and next to it, are all cells followed. So what is smaller than half a wavelength
/// on the launch plane, and met after a reflection only, may be missed.
class CurvedBounces {
 public:
  /// Keeps a reference to `look`.
  explicit CurvedBounces(const TubeLook& look);

  std::size_t blocks() const { return std::size_t{across_} * down_; }

  /// Traces one block. Thread-safe.
  TubeSums trace(std::size_t block) const;

 private:
  const TubeLook& look_;
  std::uint32_t stride_;         // cells along each side that one ray probes for
  std::uint32_t across_, down_;  // blocks
};

}  // namespace raytube
