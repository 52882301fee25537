// Rays that run inside and outside of solid bodies, from surface to surface.
#pragma once

#include <array>
#include <optional>

#include "sbr/beams/tube_look.h"
#include "sbr/solid/refraction.h"

namespace raytube {

/// The ray of a wave that leaves a surface, or the launch plane. Fields are those that a parallel beam would have, without loss.
struct SolidRay {
  Ray ray;                               // from the facet
  dvec3 point;                           // on the surface behind it, if that is curved
  double path = 0.0, loss = 0.0;         // phase is k path late, amplitude e^{-k loss} smaller at `point` [m]
  double index = 1.0;                    // of refraction, along the ray
  double attenuation = 0.0;              // see Refraction
  std::uint32_t material = no_index;     // of the solid it runs in; no_index: vacuum
  bool entered = false;                  // has been inside of one
  std::array<ComplexVector, 2> field{};  // of unit incident V and H
};

/// Where a ray meets a surface: its `ray` and `field` arrive, `point`, `path` and `loss` are those of the surface.
struct SolidHit {
  SolidRay arriving;
  std::uint32_t triangle;
  dvec3 on_facet;
  dvec3 normal;   // of the surface, unit, towards the ray
  double length;  // from surface to surface [m]
};

/// Waves at hits, at frequencies at which all materials are the same.
class SolidWaves {
 public:
  /// `frequency_index`: one of these frequencies. Keeps references.
  SolidWaves(const TubeLook& look, std::size_t frequency_index) : look_(look), frequency_(frequency_index) {}

  SolidRay launched(const dvec2& at) const;
  SolidHit meet(const SolidRay& ray, const Hit& hit) const;

  std::optional<SolidRay> reflected(const SolidHit& hit) const;
  /// Into a solid or out of it.
  std::optional<SolidRay> refracted(const SolidHit& hit) const;

  /// The surface a triangle is part of, as numbers that curved and flat ones do not share.
  std::uint64_t surface(std::uint32_t triangle) const;

 private:
  const Patch& patch(std::uint32_t triangle) const { return look_.tracer.mesh().patch_of(triangle); }
  bool at_own_boundary(const SolidHit& hit) const;
  Medium medium(std::uint32_t material) const;
  SurfaceResponse::Polarised reflection(const SolidHit& hit) const;
  SolidRay leaving(const SolidHit& hit, const dvec3& direction) const;

  const TubeLook& look_;
  std::size_t frequency_;
};

/// The larger of both fields, with losses at this wavenumber.
double amplitude(const SolidRay& ray, double wavenumber);

}  // namespace raytube
