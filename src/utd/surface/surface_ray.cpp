#include "utd/surface/surface_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

std::array<double, 3> all_three(const dvec2& l) { return {1.0 - l.x - l.y, l.x, l.y}; }

// How barycentric coordinates l1 and l2 of a triangle change along a direction in its plane [1/m].
dvec2 rate_along(const std::array<dvec3, 3>& corners, const dvec3& direction) {
  const auto& [x, y, z] = corners;
  const dvec3 across = area_vector(x, y, z), scaled = across / glm::dot(across, across);
  return {glm::dot(direction, glm::cross(z - x, scaled)), glm::dot(direction, glm::cross(scaled, y - x))};
}

}  // namespace

// c (1 + (kappa c)^2 / 24) where kappa c is small.
double arc_over(double chord, double curvature) {
  const double turn = curvature * chord;
  return chord * std::min(1.0 + turn * turn / 24.0, pi / 2);
}

Geodesic::Geodesic(const CurvatureField& curvatures, const FacetPoint& start, const dvec3& direction)
    : curvatures_(curvatures), at_(start), tangent_(direction) {}

// Over the side opposite to the corner whose coordinate falls to zero first.
Geodesic::Exit Geodesic::exit(const dvec2& rate) const {
  const std::array<double, 3> at = all_three(at_.l), slopes{-rate.x - rate.y, rate.x, rate.y};
  // A path along a side stays beside it.
  const double parallel = -1e-9 * std::max({std::abs(slopes[0]), std::abs(slopes[1]), std::abs(slopes[2])});
  Exit exit{-1, std::numeric_limits<double>::infinity()};
  for (int c = 0; c < 3; ++c) {
    const int side = (c + 1) % 3;
    if (side == entered_ || slopes[c] >= parallel) continue;
    const double length = std::max(0.0, -at[c] / slopes[c]);
    if (length < exit.length) exit = {side, length};
  }
  return exit;
}

bool Geodesic::next(GeodesicPiece& piece) {
  constexpr int most_around_a_vertex = 64;
  if (ended_ || standing_ > most_around_a_vertex) return false;
  const TriangleMesh& mesh = curvatures_.mesh();
  const SmoothSurfaces& surfaces = curvatures_.surfaces();
  const dvec3 n = curvatures_.normal(at_.triangle, at_.l), &plane = mesh.patch_of(at_.triangle).normal;
  const double square = glm::dot(n, n), facing = glm::dot(n, plane);
  if (facing < 0.2 * std::sqrt(square)) return false;  // normals that have nothing to do with the facet
  const dvec3 direction = tangent_ - (glm::dot(tangent_, plane) / facing) * n;
  tangent_ -= (glm::dot(tangent_, n) / square) * n;
  const dvec2 rate = rate_along(mesh.corners(at_.triangle), direction);
  const Exit way = exit(rate);
  if (way.side < 0) return false;
  const dvec2 to = at_.l + way.length * rate;
  const double share = std::clamp(all_three(to)[(way.side + 1) % 3], 0.0, 1.0);
  piece = {at_, to, surfaces.on_side(at_.triangle, way.side, share), direction};
  standing_ = way.length > 0.0 ? 0 : standing_ + 1;
  ended_ = surfaces.on_boundary(at_.triangle, way.side);
  entered_ = way.side;
  if (ended_) return true;
  const EdgeTable::Side next = mesh.edges()[mesh.edges().edge_of(at_.triangle, way.side)].beside(at_.triangle);
  entered_ = static_cast<int>(next.corner);
  // The neighbour runs along the side in the opposite sense.
  std::array<double, 3> l{};
  l[next.corner] = share;
  l[(next.corner + 1) % 3] = 1.0 - share;
  at_ = {next.triangle, {l[1], l[2]}};
  return true;
}

}  // namespace raytube
