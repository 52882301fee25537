// Triangles of the launch plane.
#pragma once

#include <array>
#include <vector>

#include "core/field.h"

namespace raytube {

/// A triangle of launch coordinates, and three rays about its middle that stand for it.
struct TubePiece {
  std::array<dvec2, 3> corners;
  double probe = 1.0;  // the distances of the rays from the middle, of those of the corners

  dvec2 middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
  dvec2 ray(int i) const { return middle() + probe * (corners[static_cast<std::size_t>(i)] - middle()); }
  double longest_side() const;
  double area() const;
  bool narrow() const;
};

/// Four of half the size; of one no longer than `least` itself, with its rays close to the middle; nothing if they are already.
std::vector<TubePiece> divided(const TubePiece& piece, double least);

/// With rays next to the corners.
TubePiece whole_piece(const std::array<dvec2, 3>& corners);

}  // namespace raytube
