// What scatters, in pieces small against what a sweep resolves.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "core/field.h"
#include "scene/bounce_names.h"

namespace raytube {

/// Adds s to S of one monostatic look at one frequency.
struct ScatteringPiece {
  // Where a point would be that has the same phase, and the same changes of it as frequency and direction change a little: of
  // what is reflected on its way, or runs from edges to other edges and faces, or over curved surfaces, half of the path, and
  // between where it set out and where it is last. What a wave over a surface starts at a wedge radiates from there [m].
  dvec3 place;
  ScatteringMatrix s;                     // [m]
  std::size_t mechanism = 0;              // tube_pieces, and behind them the mechanisms of the solve
  std::optional<std::uint32_t> triangle;  // of the mesh, that the current is on; edges have none
};

/// Takes one after the other, one thread at a time.
using PieceSink = std::function<void(const ScatteringPiece&)>;

}  // namespace raytube
