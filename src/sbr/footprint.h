// What a bundle of parallel tubes does at one surface: its footprint, the physical-optics current there and its far field.
#pragma once

#include <array>

#include "field.h"
#include "mesh/triangle_mesh.h"
#include "sbr/launch.h"

namespace raytube {

/// Tubes that have met the same planar patches in the same order travel as one plane wave: direction d, phase
/// e^{-jk (d.r + path)}, fields of both transmit polarisations. The tube of launch coordinates (u, v) runs through
/// base + (u - anchor.x) along_u + (v - anchor.y) along_v. `u_hat`, `v_hat` and the direction are orthonormal: the launch axes as
/// the reflections carry them, so that the launch coordinates of any point r are anchor + (u_hat, v_hat).(r - base).
struct Beam {
  dvec3 direction;
  double path = 0.0;           // [m]
  std::array<dvec3, 2> field;  // of unit incident V and H
  dvec2 anchor;
  dvec3 base, along_u, along_v;
  dvec3 u_hat, v_hat;
};

/// The incident plane wave as launched; phase zero at the centre of the mesh.
Beam incident_beam(const LaunchGrid& grid, const SphericalBasis& transmit, const dvec2& anchor);

/// The same beam, described from elsewhere: an anchor close to the tubes in question keeps their places exact on planes that the
/// beam grazes, which run away from a distant one.
Beam anchored(Beam beam, const dvec2& anchor);

/// The same tubes where they meet a plane: points base + ..., current ready for the integral, and the beam that leaves.
struct Footprint {
  Beam outgoing;                                     // base and along_* lie on the surface
  std::array<std::array<double, 2>, 2> weight;       // [receive][transmit] p_hat . eta J per unit field
  double area = 0.0;                                 // footprint area per unit launch area
  double phase = 0.0, phase_u = 0.0, phase_v = 0.0;  // exponent / k at the anchor, and per metre along u and v
};

/// Physical-optics footprint of `beam` on the plane of `patch`, lit from the side the beam comes from, seen by `receive`.
/// Valid for a perfect conductor large in wavelengths.
Footprint footprint(const Beam& beam, const Patch& patch, const SphericalBasis& receive);

/// Integral of e^{jk (...)} over a launch rectangle of sides (width, height) about the launch point `center`: a product of two
/// sinc, exact for a plane of any size [m^2].
Complex phase_integral(const Footprint& f, double k, const dvec2& center, double width, double height);

/// S = -(jk / 4 pi) p_hat . eta J * integral: far field of an electric surface current (Stratton & Chu 1939).
void add_far_field(ScatteringMatrix& sum, const Footprint& f, double k, Complex integral);

}  // namespace raytube
