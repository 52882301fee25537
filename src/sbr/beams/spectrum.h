// Waves that have met other than perfect conductors: complex, and different at every frequency.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/complex_vector.h"
#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"

namespace raytube {

/// A wave that leaves a surface, at one frequency.
struct SpectralWave {
  std::array<ComplexVector, 2> field;  // of unit incident V and H
  ChannelWeights weight{};             // p . (eta J - s x M) of the currents it leaves behind, [receive][transmit]
  std::array<double, 2> incoherent{};  // sigma per area across the arriving wave of what roughness scatters, for unit V and H
};

/// A wave that leaves a surface, [frequency] of a look.
using Spectrum = std::vector<SpectralWave>;

/// The spectrum of a wave whose fields are real and do not depend on frequency.
Spectrum plain_spectrum(const std::array<dvec3, 2>& field, std::size_t frequencies);

/// Waves of a smaller amplitude, of unit incident ones, end: they would go to and fro between sheets and bring no digit that
/// counts.
inline constexpr double least_amplitude = 1e-9;

/// The larger one of both fields at the frequency where it is largest.
double amplitude(const Spectrum& spectrum);

/// What the patches of a look's target are made of (Patch::material), and its wavenumbers.
struct SpectralSurfaces {
  std::span<const Material> materials;    // [Patch::material], at the frequencies of the sweep
  std::span<const double> wavenumbers;    // [frequency] [rad/m]
  std::size_t first_frequency_index = 0;  // among the materials' frequencies, of the first of these wavenumbers

  /// What a material does to a wave that comes in at this angle, `cosine` from the normal. no_index: a perfect conductor.
  SurfaceResponse response(std::uint32_t material, std::size_t frequency_index, double cosine, bool from_behind) const;
  /// Share of the power reflected by the smooth surface that roughness takes from it.
  double incoherent_share(std::uint32_t material, std::size_t frequency_index, double cosine) const;
  /// The largest shares of a wave's amplitude, at any frequency, that a sheet reflects and lets through; of what is opaque 1 and
  /// 0.
  std::array<double, 2> strongest(const Patch& patch, const dvec3& direction) const;
  /// Whether roughness scatters anything.
  bool any_rough() const { return raytube::any_rough(materials); }
  /// Whether waves go on behind a surface of this material.
  bool transmits(std::uint32_t material) const { return material != no_index && materials[material].transmits(); }
};

/// Where a wave meets a surface. `normal` points to the side the wave comes from.
struct Incidence {
  dvec3 direction, normal;            // of propagation; of the surface. Unit
  std::uint32_t material = no_index;  // no_index: a perfect conductor
  bool from_behind = false;           // the surface's own normal points the other way
  bool reflected = false;             // somewhere before: no longer the incident wave

  /// Cosine of the angle of incidence.
  double cosine() const { return -glm::dot(direction, normal); }
};

/// ChannelWeights of the currents that radiate a wave of direction `d` from a plane of normal `n`, to the side it points to, and
/// nothing to the other: J = n x H, M = -n x E (Love's principle).
ChannelWeights radiated(const dvec3& n, const dvec3& d, const std::array<ComplexVector, 2>& field, const SphericalBasis& receive);

/// What the receiver's own V and H waves become behind a sheet that stands before it: line-of-sight transmission.
ChannelWeights through_screen(const SpectralSurfaces& surfaces, const Patch& patch, std::size_t frequency_index,
                              const SphericalBasis& receive);

/// What weights become behind a sheet, by its through_screen(): of the receiver's V and H.
ChannelWeights received_through(const ChannelWeights& screen, const ChannelWeights& weights);

/// The waves that leave a surface. The weights are the reflected one's: S of a current is -(jk / 4 pi) times the integral of
/// p . (eta J - s x M) e^{jk s.r} (Stratton & Chu 1939). Where a reflected wave meets a sheet only the part of the currents
/// counts that reflects it: behind the sheet its sources are received through it. What roughness takes from the reflected wave
/// goes into all directions above the surface by Lambert's law, without memory of polarisation: sigma = 4 (1 - rho^2) |R|^2 A
/// cos(theta_i) cos(theta_s), of both receive polarisations together (effective roughness: Degli-Esposti et al. 2007, IEEE Trans.
/// AP-55, 143).
struct LeavingWaves {
  Spectrum reflected, transmitted;  // transmitted: empty where the surface lets nothing through
};
/// `receive` is the basis of the receive direction.
LeavingWaves leaving_waves(const SpectralSurfaces& surfaces, const Incidence& incidence, const Spectrum& arriving,
                           const SphericalBasis& receive);

}  // namespace raytube
