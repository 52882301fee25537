// A narrow tube with a curved wavefront: a ray, and how it changes across the launch plane.
#pragma once

#include "math/chebyshev.h"
#include "mesh/smooth/smooth.h"
#include "sbr/beams/footprint.h"
#include "scene/antenna.h"

namespace raytube {

/// A ray and its derivatives with respect to the launch coordinates (ray differentials, Igehy 1999, eqs. 9-16, with the normal's
/// derivative from the surface's curvature). Geometrical optics carries the field: its magnitude follows the tube's
/// cross-section, and each caustic on the way adds a quarter turn, e^{+j pi/2} (Kouyoumjian & Pathak 1974, below eq. 8).
struct CurvedBeam {
  dvec3 base;                  // where the tube's middle left the last surface [m]
  dvec3 direction;             // unit
  dvec3 along_u, along_v;      // d base / du, dv
  dvec3 bend_u, bend_v;        // d direction / du, dv [1/m]
  double path = 0.0;           // phase e^{-jk (d.r + path)} at the tube's middle [m]
  std::array<dvec3, 2> field;  // of unit incident V and H, at unit amplitude
  Spectrum spectrum{};         // instead, once the tube has met other than perfect conductors
  int caustics = 0;            // passed so far
  bool reflected = false;      // by any surface; false of the incident wave, behind sheets too
};

/// The tube about the launch point `at`, as launched.
CurvedBeam launched_beam(const LaunchGrid& grid, const SphericalBasis& transmit, const dvec2& at);
/// A tube launched from an antenna at a finite distance, the grid's own. Its field is that of unit cross-section: the antenna's,
/// times the root of the tube's.
CurvedBeam launched_beam(const LaunchGrid& grid, const Antenna& transmit, const dvec2& at);

/// The receiver as a point of a surface sees it.
struct Reception {
  SphericalBasis basis;    // radial towards it, unit; theta_hat and phi_hat the fields that V and H would send to the point
  double beyond = 0.0;     // what the exponent / k has there beyond basis.radial . r [m]
  double curvature = 0.0;  // 1 / distance; 0: at infinity [1/m]
};

/// The reception by an antenna at a finite distance.
Reception reception_at(const Antenna& receive, const dvec3& point);

/// The currents of a tube on a surface: a quadratic phase over the launch coordinates counted from the tube's middle.
struct CurvedFootprint {
  // [receive][transmit] p . eta J times `strength`; not used where the outgoing beam has a spectrum.
  std::array<std::array<Complex, 2>, 2> weight;
  Complex strength;    // amplitude times the surface per launch area
  double phase = 0.0;  // exponent / k
  dvec2 slope{0.0};
  glm::dmat2 curvature{0.0};
  CurvedBeam outgoing;
  Spectrum transmitted{};  // of the wave that goes on as it came, behind a sheet; empty: none
};

/// Where a tube meets a perfect conductor that its middle ray meets at `surface.point`.
CurvedFootprint curved_footprint(const CurvedBeam& beam, const LocalSurface& surface, const Reception& receive);

/// Where a tube meets a surface of any material, that of `patch`; with the spectrum of the wave that leaves unless nothing but
/// perfect conductors has been met.
CurvedFootprint curved_footprint(const CurvedBeam& beam, const LocalSurface& surface, const Reception& receive,
                                 const SpectralSurfaces& surfaces, const Patch& patch);

/// Adds S of the footprint's currents over a launch rectangle of this size [m] about the tube's middle, at wavenumber `k`
/// [rad/m], which is that of `frequency_index` in its spectrum.
void add_far_field(ScatteringMatrix& sum, const CurvedFootprint& f, std::size_t frequency_index, double k, const dvec2& size);

/// Adds S at all wavenumbers of a band; of many, on perfect conductors, a few are computed and the others interpolated.
void add_far_fields(std::vector<ScatteringMatrix>& sums, const CurvedFootprint& f, Band& band, const dvec2& size);

}  // namespace raytube
