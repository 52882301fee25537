// Spherical waves on other than perfect conductors: at every point a plane wave of the local direction.
#pragma once

#include <vector>

#include "sbr/beams/beam.h"
#include "scene/antenna.h"

namespace raytube {

/// A plane that a wave has met.
struct MetSurface {
  dvec3 normal;                       // unit
  std::uint32_t material = no_index;  // no_index: a perfect conductor
  bool goes_on = false;               // the wave is the one behind it
};

/// What a spherical wave has met from the first surface on that is no perfect conductor. A sheet has no thickness: rays run
/// straight on behind it.
struct SurfacesMet {
  Beam arriving;                      // at the first of them
  std::vector<MetSurface> surfaces;   // in order; the last one carries the currents
  bool reflected = false;             // before the last one: no longer the incident wave
  std::vector<MetSurface> screens{};  // between the currents and the receiver, in order
};

/// What `beam` has met once it has met this surface as well. `reflected`: somewhere before.
SurfacesMet with_surface(const Beam& beam, const MetSurface& surface, bool reflected);

/// Both waves that leave the last surface at a point. `ray` is the wave that comes to the first one, folded back; its direction
/// becomes that at the last one. `receive`: see leaving_waves.
LeavingWaves leaving_waves(const SpectralSurfaces& surfaces, const SurfacesMet& met, AntennaRay& ray,
                           const SphericalBasis& receive);

/// What the receiver makes of currents at a point.
struct ReceivedCurrents {
  std::vector<ChannelWeights> weight;             // [frequency] E_p . eta J_q - eta H_p . M_q, E_p and H_p the receiver's wave
  std::vector<std::array<double, 2>> incoherent;  // [frequency] sigma per area of the surface; empty: nothing is rough
};

/// What is received of the currents on the last surface; `ray` as above, `received` what the receiving antenna would send to the
/// point. Behind screens: what they are through all of these less what they are without the last one. Valid where the
/// coefficients change little over the angle sqrt(wavelength / distance), in which a point's neighbours radiate together.
ReceivedCurrents received_currents(const SpectralSurfaces& surfaces, const SurfacesMet& met, AntennaRay& ray,
                                   const AntennaRay& received);

/// The largest shares of a wave's amplitude, at any frequency, that a surface reflects and lets through of rays all over a
/// target of this radius.
std::array<double, 2> strongest(const SpectralSurfaces& surfaces, const Beam& beam, const Patch& plane, double radius);

}  // namespace raytube
