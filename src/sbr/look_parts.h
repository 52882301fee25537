// The parts that a look is traced in, tile by tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"

namespace raytube {

/// What of a look is traced together, on a grid of one density.
enum class PartKind {
  uniform,         // everything, by the grid's cells
  flat,            // flat faces and what they reflect: by polygons, or by cells where these are cheaper
  curved,          // currents that a plane wave excites on curved surfaces
  curved_near,     // currents that an antenna at a finite distance excites on curved surfaces
  curved_bounces,  // what curved surfaces reflect
  solid            // waves that have been inside of solid bodies
};

/// How a part of a look is traced, at all its frequencies alike: by polygons or not, and in how many blocks that can have grids
/// of different density. Polygons that are refined have many, whatever number of frequencies share them.
struct Division {
  bool polygons = false;
  std::size_t blocks = 1;
};

/// How a part of a look with all its frequencies is traced.
Division divide(PartKind kind, const TubeLook& look);

/// Traces some blocks of a part, in rising order, and adds up the tiles of each in order, whoever computes them: one thread where
/// the look has a map, else all. Reports finished tiles as shares of `share` to `progress`. Throws Interrupted when the solve is
/// stopped.
std::vector<TubeSums> trace_blocks(PartKind kind, const Division& division, const TubeLook& look,
                                   std::span<const std::size_t> blocks, Progress& progress, double share);

/// Blocks of a part at most: enough to refine a vehicle where it needs it, at 0.3 MB a frequency.
inline constexpr std::size_t most_blocks = 256;

/// Faces whose tubes are followed together, as one tile, where no sheets let waves through.
inline constexpr std::uint32_t faces_per_tile = 256;
/// Between sheets tubes double at every meeting, so that those of few faces are many.
inline constexpr std::uint32_t faces_per_tile_with_sheets = 8;
/// Through a solid every triangle is many rays.
inline constexpr std::uint32_t triangles_per_solid_tile = 16;

/// Bytes of the sums of a tile at most.
double tile_sum_bytes(int bounces, std::size_t frequencies);

/// Tiles whose sums are held at a time.
std::size_t tiles_per_batch(int bounces, std::size_t frequencies);

}  // namespace raytube
