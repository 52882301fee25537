// One tile of the launch grid, traced and integrated by one thread.
#pragma once

#include "sbr/flat/cell_tubes.h"
#include "sbr/launch/tile.h"

namespace raytube {

/// Traces tile after tile of one look; kept from one to the next is only memory. Where the look has curved surfaces, only tubes
/// that meet a flat one first. Keeps a reference to the look.
class TileTracer {
 public:
  explicit TileTracer(const TubeLook& look)
      : look_(look),
        beams_(look.tracer.mesh(), look.surfaces, look.receive, incident_beam(look.grid, look.transmit, dvec2(0.0))),
        tubes_(look, beams_, sums_) {}
  TileTracer(const TileTracer&) = delete;

  /// Traces every tube of the tile through up to `max_bounces` reflections and integrates the currents of every bounce, over the
  /// cells and over those of a grid three times as coarse. The tile begins at a column and a row divisible by three.
  TubeSums trace(const CellBlock& tile);

 private:
  void launch(const CellBlock& tile);

  const TubeLook& look_;
  BeamTree beams_;
  TubeSums sums_;
  CellTubes tubes_;
};

}  // namespace raytube
