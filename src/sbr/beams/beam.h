// A bundle of tubes between two surfaces, as a plane wave or as the spherical wave of an antenna or of its image: where in space
// its launch coordinates lie.
//
// The central header of this folder: beams (beam, beam_tree), their currents (footprint, and spectrum where materials make them
// complex), what these radiate (polygon_integral over polygons, far_fields over cells, spherical_look near the antennas) and what
// that adds up to (tube_sums, estimate, current_map). Notation, here and in the other folders of sbr:
//   u, v   launch coordinates [m]: where a tube sets out, along the axes of the LaunchGrid
//   d, s   directions of propagation of a wave and to the receiver, unit vectors; k the wavenumber [rad/m]
//   p, q   index of the receive and of the transmit polarisation: 0 V (theta_hat), 1 H (phi_hat); S_pq [m]
//   path   length L [m] by which the phase of a wave e^{-jk (d.r + L)} is late; time convention e^{+j omega t}
//   S = -(jk / 4 pi) p . integral of eta J e^{jk s.r} dA over the currents J = 2 n x H of every bounce
#pragma once

#include <array>

#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"
#include "sbr/beams/spectrum.h"
#include "sbr/launch/convex_polygon.h"
#include "sbr/launch/launch.h"

namespace raytube {

struct SurfacesMet;

/// Tubes that have met the same planar patches in the same order travel as one wave.
///
/// Plane wave: direction d, phase e^{-jk (d.r + path)}, fields of both transmit polarisations. The tube of launch coordinates (u,
/// v) runs through base + (u - anchor.x) along_u + (v - anchor.y) along_v. `u_hat`, `v_hat` and the direction are orthonormal:
/// the launch axes as the reflections carry them, so that the launch coordinates of any point r are anchor + (u_hat, v_hat).(r -
/// base), its depth d.(r - base).
///
/// Spherical wave: all rays come from base - d / curvature, the image of the antenna, and base is the image of the middle of the
/// target. Launch coordinates and depth are (u_hat, v_hat, d).(r - base) divided by the widening w = 1 + curvature d.(r - base).
/// This homography keeps planes and straight lines and makes the rays parallel, so what is said of polygons and depths of a plane
/// wave holds here too. `anchor` is zero; path, fields, along_u and along_v are not used.
struct Beam {
  dvec3 direction{0.0};
  double path = 0.0;             // [m]
  std::array<dvec3, 2> field{};  // of unit incident V and H
  dvec2 anchor{0.0};
  dvec3 base{0.0}, along_u{0.0}, along_v{0.0};
  dvec3 u_hat{0.0}, v_hat{0.0};
  double curvature = 0.0;     // of the wavefront at the base [1/m]; 0: a plane wave
  double launch_depth = 0.0;  // [m] spherical wave: where its tubes begin if they leave no surface
  // What takes the place of `field` once the wave has met other than perfect conductors.
  const Spectrum* spectrum = nullptr;
  const SurfacesMet* met = nullptr;  // the same of a spherical wave, whose fields are those of each point

  bool spherical() const { return curvature != 0.0; }
};

/// The incident wave as launched. Plane: phase zero at the centre of the mesh.
Beam incident_beam(const LaunchGrid& grid, const SphericalBasis& transmit, const dvec2& anchor);

/// A beam described from another anchor, one close to the tubes in question: on planes that the beam grazes, which run away from
/// a distant anchor, points stay exact. A spherical beam is returned as it is.
Beam anchored(Beam beam, const dvec2& anchor);

/// The spherical wave that a plane sends back, from the image of its source.
Beam reflected_spherical(const Beam& beam, const Patch& plane);

/// Below zero: the beam comes to the plane from the side its normal points to. For a plane wave normal . direction; for a
/// spherical one the distance of its source from the plane over that from the base, so that |facing| turns depths into heights.
double facing(const Beam& beam, const Patch& plane);

/// Depth of a plane along the beam, counted from its base.
Affine depth_of(const Beam& beam, const Patch& plane);

/// How much wider a spherical wave is at a point than at its base; not above zero: behind its source.
inline double widening(const Beam& beam, const dvec3& r) {
  return 1.0 + beam.curvature * glm::dot(beam.direction, r - beam.base);
}
/// How much wider it is at a depth than at its base.
inline double widening_at(const Beam& beam, double depth) { return 1.0 / (1.0 - beam.curvature * depth); }

/// Launch coordinates of a point.
inline dvec2 launch_coordinates(const Beam& beam, const dvec3& r) {
  const dvec3 step = r - beam.base;
  const dvec2 at{glm::dot(beam.u_hat, step), glm::dot(beam.v_hat, step)};
  return beam.spherical() ? at / widening(beam, r) : beam.anchor + at;
}

/// The point of a spherical wave at these launch coordinates and depth.
inline dvec3 point_at(const Beam& beam, const dvec2& at, double depth) {
  return beam.base + widening_at(beam, depth) * (at.x * beam.u_hat + at.y * beam.v_hat + depth * beam.direction);
}

/// The tube's ray from the surface it leaves; null: as launched.
Ray tube_ray(const Beam& beam, const dvec2& at, const Patch* source, std::uint32_t source_patch);

/// All that the beam can meet of a box in launch coordinates, or of a polygon in that box if one is given, perhaps more: up to a
/// depth, of a target of this radius about the origin.
Prism prism_of(const Beam& beam, const Patch* source, const Bounds& box, const ConvexPolygon* region, double farthest,
               double radius);

}  // namespace raytube
