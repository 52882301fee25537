// One tile of the launch grid, traced and integrated by one thread.
#pragma once

#include <span>

#include "mesh/model/face_tree.h"
#include "sbr/flat/cell_tubes.h"

namespace raytube {

/// A block of cells [column_begin, column_end) x [row_begin, row_end) of a launch grid.
struct Tile {
  std::uint32_t column_begin, column_end, row_begin, row_end;
};

// Multiples of three, so that no group of the coarse grid is cut, and of the packet's width.
inline constexpr std::uint32_t tile_columns = 48, tile_rows = 45;

/// What a look need not trace.
struct NotTraced {
  const FaceTree* faces = nullptr;  // cells under which none of these lies launch no tube; null: all do
  bool reflected_tubes = false;     // they meet nothing
};

/// Traces tile after tile of one look, with `smooth` only tubes that meet a flat surface first; kept from one to the next is
/// only memory. Keeps references to all it is given.
class TileTracer {
 public:
  TileTracer(const Tracer& tracer, const SpectralSurfaces& surfaces, const LaunchGrid& grid, const SphericalBasis& transmit,
             const SphericalBasis& receive, const SphericalLook* spherical, int max_bounces, const SmoothSurfaces* smooth,
             const NotTraced& not_traced, const LineOfSightSheets* sheets, CurrentMap* map)
      : grid_(grid),
        transmit_(transmit),
        max_bounces_(max_bounces),
        not_traced_(not_traced),
        beams_(tracer.mesh(), surfaces, receive, incident_beam(grid, transmit, dvec2(0.0))),
        tubes_(tracer, grid, spherical, surfaces.wavenumbers, beams_, sums_) {
    tubes_.leave_out(smooth);
    tubes_.look_through(sheets);
    tubes_.report_to(map);
  }
  TileTracer(const TileTracer&) = delete;

  /// Traces every tube of the tile through up to `max_bounces` reflections and integrates the currents of every bounce, over the
  /// cells and over those of a grid three times as coarse. The tile begins at a column and a row divisible by three.
  TubeSums trace(const Tile& tile);

 private:
  void launch(const Tile& tile);

  const LaunchGrid& grid_;
  const SphericalBasis& transmit_;
  int max_bounces_;
  NotTraced not_traced_;
  BeamTree beams_;
  TubeSums sums_;
  CellTubes tubes_;
};

}  // namespace raytube
