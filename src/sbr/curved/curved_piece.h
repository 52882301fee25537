// A piece of a curved surface: the quadric about a point instead of the plane through it.
#pragma once

#include "math/conic.h"
#include "mesh/smooth/smooth.h"
#include "sbr/launch/launch.h"

namespace raytube {

/// A surface to second order as the parallel rays of a look see it: a depth over the launch plane, up to its own shadow boundary,
/// where the rays graze it.
class CurvedPiece {
 public:
  CurvedPiece(const LaunchGrid& grid, const LocalSurface& surface, std::uint32_t material = no_index, bool from_behind = false);

  /// The launch coordinates of the point it is expanded about [m].
  const dvec2& anchor() const { return anchor_; }

  /// Positive where a ray meets the surface, zero at its shadow boundary; in launch coordinates counted from the anchor.
  const Conic& shadow_boundary() const { return shadow_boundary_; }

  /// Depth behind the anchor's point [m] and its slopes along u and v; beyond the shadow boundary, the depth of that boundary.
  /// `from_anchor` is counted as for the shadow boundary.
  struct Depth {
    double depth, slope_u, slope_v;
  };
  Depth depth(const dvec2& from_anchor) const;

  /// How far a point lies off the surface, to first order [m].
  double distance(const dvec3& point) const;

  const LocalSurface& surface() const { return surface_; }
  std::uint32_t material() const { return material_; }
  bool from_behind() const { return from_behind_; }

 private:
  LocalSurface surface_;
  std::uint32_t material_;
  bool from_behind_;
  dvec2 anchor_;
  dvec3 normal_;           // along (u_hat, v_hat, direction)
  glm::dmat3 curve_;       // in the same frame
  Conic shadow_boundary_;  // the discriminant of the quadratic equation for the depth
};

}  // namespace raytube
