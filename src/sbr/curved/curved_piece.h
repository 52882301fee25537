// Physical optics on a curved surface lit by a plane wave: the quadric about a point instead of the plane through it.
#pragma once

#include <span>

#include "math/conic.h"
#include "mesh/features/smooth.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/launch/convex_polygon.h"
#include "sbr/launch/launch.h"

namespace raytube {

/// What lights a look and what is asked of it.
struct Illumination {
  const LaunchGrid& grid;
  const SphericalBasis& transmit;
  const SphericalBasis& receive;
  SpectralSurfaces surfaces;
};

/// A surface to second order as the parallel rays of a look see it: a depth over the launch plane, up to its own limb, where the
/// rays graze it.
class CurvedPiece {
 public:
  CurvedPiece(const LaunchGrid& grid, const LocalSurface& surface, std::uint32_t material = no_index, bool from_behind = false);

  /// The launch coordinates of the point it is expanded about.
  const dvec2& anchor() const { return anchor_; }

  /// Positive where a ray meets the surface, zero on the limb; in launch coordinates counted from the anchor.
  const Conic& limb() const { return shadow_boundary_; }

  /// Depth behind the anchor's point and its slopes along u and v; beyond the limb, that of the limb. `from_anchor` as for the
  /// limb.
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

/// Far field of the physical-optics currents on the piece within a launch rectangle, [frequency].
/// S = -(jk / 4 pi) p . integral of 2 n x (d x e) e^{jk (s - d).r} over the lit surface, in launch coordinates, where the surface
/// element carries n x (d x e) dS = [p.e + (p.d) (e . grad depth)] du dv; of other materials than a perfect conductor the
/// currents of the plane tangential to the surface.
/// `sums`, if any, is told what the surface scatters incoherently.
std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const Bounds& cell,
                                               TubeSums* sums = nullptr);

/// The same over a convex polygon of the launch plane that stays clear of the limb.
std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const ConvexPolygon& polygon,
                                               TubeSums* sums = nullptr);

/// The range of the exponent of that integral over a rectangle, divided by the wavenumber [m].
double path_range(const Illumination& light, const CurvedPiece& piece, const Bounds& cell);

}  // namespace raytube
