#include "sbr/solid/tube_piece.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// Rays never run along edges of a mesh; those of narrow pieces are neighbours, though rounding does not move them together.
constexpr double beside_corners = 1.0 - 1e-6, next_to_middle = 1e-3;

}  // namespace

TubePiece whole_piece(const std::array<dvec2, 3>& corners) { return {corners, beside_corners}; }

double TubePiece::longest_side() const {
  return std::max(
      {glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]), glm::distance(corners[2], corners[0])});
}

double TubePiece::area() const {
  const dvec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
  return 0.5 * std::abs(a.x * b.y - a.y * b.x);
}

bool TubePiece::narrow() const { return probe <= next_to_middle; }

std::vector<TubePiece> divided(const TubePiece& piece, double least) {
  if (piece.narrow()) return {};
  if (piece.longest_side() <= least) return {{piece.corners, next_to_middle}};
  const auto& [a, b, c] = piece.corners;
  const dvec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  return {whole_piece({a, ab, ca}), whole_piece({ab, b, bc}), whole_piece({ca, bc, c}), whole_piece({bc, ca, ab})};
}

}  // namespace raytube
