#include "sbr/curved/curved_piece.h"

#include <cmath>

namespace raytube {

CurvedPiece::CurvedPiece(const LaunchGrid& grid, const LocalSurface& surface, std::uint32_t material, bool from_behind)
    : surface_(surface), material_(material), from_behind_(from_behind) {
  const dvec3 from_plane = surface.point - grid.plane_origin;
  anchor_ = {glm::dot(from_plane, grid.u_hat), glm::dot(from_plane, grid.v_hat)};
  const glm::dmat3 frame(grid.u_hat, grid.v_hat, grid.direction);
  normal_ = glm::transpose(frame) * surface.normal;
  curve_ = glm::transpose(frame) * surface.curvature * frame;
  // Depth t over the launch point w: a t^2 + b t + c = 0 with the coefficients of depth(); b^2 - 4 a c collected in w.
  const dvec2 tilt(curve_[2]);
  const double a = -0.5 * curve_[2][2];
  shadow_boundary_.c = normal_.z * normal_.z;
  shadow_boundary_.g = -2.0 * normal_.z * tilt - 4.0 * a * dvec2(normal_);
  shadow_boundary_.m = glm::outerProduct(tilt, tilt) + 2.0 * a * glm::dmat2(curve_);
}

CurvedPiece::Depth CurvedPiece::depth(const dvec2& from_anchor) const {
  const dvec3 w(from_anchor, 0.0), curved = curve_ * w;
  const double a = -0.5 * curve_[2][2], b = normal_.z - curved.z, c = glm::dot(normal_, w) - 0.5 * glm::dot(w, curved);
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant <= 0.0) return {a == 0.0 ? 0.0 : -0.5 * b / a, 0.0, 0.0};
  const double root = std::sqrt(discriminant), depth = -2.0 * c / (b - root);
  const dvec3 gradient = normal_ - curve_ * dvec3(from_anchor, depth);
  return {depth, gradient.x / root, gradient.y / root};
}

double CurvedPiece::distance(const dvec3& point) const {
  const dvec3 x = point - surface_.point, curved = surface_.curvature * x;
  return std::abs(glm::dot(surface_.normal, x) - 0.5 * glm::dot(x, curved)) / glm::length(surface_.normal - curved);
}

}  // namespace raytube
