// What a bundle of parallel tubes does at one surface: its footprint, the physical-optics current there and its far field.
#pragma once

#include <array>

#include "core/field.h"
#include "mesh/model/triangle_mesh.h"
#include "sbr/beams/beam.h"

namespace raytube {

/// The tubes of a beam where they meet a plane: points base + (u - anchor.x) along_u + (v - anchor.y) along_v, the current ready
/// for the integral, and the beam that leaves.
struct Footprint {
  Beam outgoing;  // base and along_* lie on the surface
  // [receive][transmit] p_hat . eta J per unit field; not used where the outgoing beam has a spectrum, which has its own.
  std::array<std::array<double, 2>, 2> weight;
  double area = 0.0;                                 // footprint area per unit launch area
  double phase = 0.0, phase_u = 0.0, phase_v = 0.0;  // exponent / k at the anchor, and per metre along u and v
};

/// Physical-optics footprint of a plane wave `beam` on the plane of `patch`, lit from the side the beam comes from, received
/// along `receive`. Valid for a perfect conductor large in wavelengths; for other materials as well but for fields and weights.
Footprint footprint(const Beam& beam, const Patch& patch, const SphericalBasis& receive);

/// Both waves that leave the patch for a beam with or without a spectrum, whatever it is made of. `reflected`: see Incidence.
LeavingWaves leaving_waves(const SpectralSurfaces& surfaces, const Beam& beam, bool reflected, const Patch& patch,
                           const SphericalBasis& receive);

/// The largest magnitude of a weight at any frequency.
double largest_weight(const Footprint& f, int p, int q);

/// Integral of e^{jk (...)} over a launch rectangle of sides (width, height) about the launch point `center`: a product of two
/// sinc, exact for a plane of any size [m^2].
Complex phase_integral(const Footprint& f, double k, const dvec2& center, double width, double height);

/// S = -(jk / 4 pi) p_hat . eta J * integral: far field of an electric surface current (Stratton & Chu 1939), and of a magnetic
/// one where the beam has a spectrum; `k` [rad/m] is the wavenumber of `frequency_index` in it, `integral` in [m^2].
void add_far_field(ScatteringMatrix& sum, const Footprint& f, std::size_t frequency_index, double k, Complex integral);

}  // namespace raytube
