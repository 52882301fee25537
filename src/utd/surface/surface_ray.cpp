#include "utd/surface/surface_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

std::array<double, 3> all_three(const dvec2& l) { return {1.0 - l.x - l.y, l.x, l.y}; }

}  // namespace

// c (1 + (kappa c)^2 / 24) where kappa c is small.
double arc_over(double chord, double curvature) {
  const double turn = curvature * chord;
  return chord * std::min(1.0 + turn * turn / 24.0, pi / 2);
}

Geodesic::Geodesic(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, const CurvatureField& curvatures,
                   const FacetPoint& start, const dvec3& direction)
    : mesh_(mesh), surfaces_(surfaces), curvatures_(curvatures), at_(start), tangent_(direction) {}

dvec3 Geodesic::normal() const {
  const std::array<double, 3> l = all_three(at_.l);
  dvec3 sum(0.0);
  for (int c = 0; c < 3; ++c) sum += l[c] * curvatures_.normal(at_.triangle, c);
  return sum;
}

// How the barycentric coordinates change per metre along a vector of the facet's plane.
dvec2 Geodesic::barycentric(const dvec3& along) const {
  const Triangle& t = mesh_.triangles[at_.triangle];
  const dvec3 a = mesh_.vertices[t[1]] - mesh_.vertices[t[0]], b = mesh_.vertices[t[2]] - mesh_.vertices[t[0]];
  const dvec3 across = glm::cross(a, b);
  const double square = glm::dot(across, across);
  return {glm::dot(glm::cross(along, b), across) / square, glm::dot(glm::cross(a, along), across) / square};
}

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
  const dvec3 n = normal(), plane = mesh_.patch_of(at_.triangle).normal;
  const double square = glm::dot(n, n), facing = glm::dot(n, plane);
  tangent_ = glm::normalize(tangent_ - (glm::dot(tangent_, n) / square) * n);
  if (facing < 0.2 * std::sqrt(square)) return false;  // normals that have nothing to do with the facet
  const dvec3 direction = glm::normalize(tangent_ - (glm::dot(tangent_, plane) / facing) * n);
  const dvec2 rate = barycentric(direction);
  const Exit way = exit(rate);
  if (way.side < 0) return false;
  piece = {at_, at_.l + way.length * rate, direction};
  standing_ = way.length > 0.0 ? 0 : standing_ + 1;
  const std::array<double, 3> left = all_three(piece.to);
  ended_ = surfaces_.on_boundary(at_.triangle, way.side);
  if (ended_)
    entered_ = way.side;
  else
    enter(way.side, std::clamp(left[(way.side + 1) % 3], 0.0, 1.0));
  return true;
}

// Over side `corner` of the triangle, at `share` of it.
void Geodesic::enter(int corner, double share) {
  const EdgeTable::Edge edge = mesh_.edges()[mesh_.edges().edge_of(at_.triangle, corner)];
  const EdgeTable::Side& other = edge.beside(at_.triangle);
  const Triangle &t = mesh_.triangles[at_.triangle], &u = mesh_.triangles[other.triangle];
  const int from = static_cast<int>(other.corner), to = (from + 1) % 3;
  const double part = u[from] == t[corner] ? share : 1.0 - share;
  std::array<double, 3> l{};
  l[from] = 1.0 - part;
  l[to] = part;
  at_ = {other.triangle, {l[1], l[2]}};
  entered_ = from;
}

}  // namespace raytube
