// What faces of any material make of the waves of an edge: at every ray a plane wave (Fresnel's coefficients in the place of a
// conductor's).
#pragma once

#include <array>
#include <span>

#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"

namespace raytube {

/// What faces are made of, at the wavenumbers of a solve.
struct FaceMaterials {
  std::span<const Material> materials{};       // empty: every face is a perfect conductor
  std::span<const std::size_t> frequencies{};  // [wavenumber], its index in the materials

  bool any() const { return !materials.empty(); }
  /// The response of a face that a wave meets at this cosine.
  SurfaceResponse response(std::uint32_t material, std::size_t index, double wavenumber, double cosine, bool from_behind) const;
};

/// A face as a wave meets it.
struct MetFace {
  dvec3 normal;                       // unit, of its patch
  std::uint32_t material = no_index;  // no_index: a perfect conductor

  explicit MetFace(const Patch& patch) : normal(patch.normal), material(patch.material) {}
};

/// The receiver as a point of a face sees it: the fields that V and H would send there, and the direction to it.
struct FaceReceiver {
  std::array<dvec3, 2> field;
  dvec3 direction;  // unit
};

/// eta H of a wave after its reflection by the face: it has eta H `magnetic` along `direction`, at one of the wavenumbers.
ComplexVector reflected_magnetic(const FaceMaterials& materials, const MetFace& face, const dvec3& direction,
                                 const ComplexVector& magnetic, std::size_t index, double wavenumber);

/// The currents of that wave as the receiver has them: p . eta J + (s x p) . M for both of its fields p, s its direction.
std::array<Complex, 2> received_currents(const FaceMaterials& materials, const MetFace& face, const dvec3& direction,
                                         const ComplexVector& magnetic, const FaceReceiver& receiver, std::size_t index,
                                         double wavenumber);

/// [own wave][transmit] the fields of V and H that a wave of this direction has after faces met in this order, in units of what
/// perfect conductors in their place would leave, `electric`.
ChannelWeights weights_after(const FaceMaterials& materials, std::span<const MetFace> faces, const dvec3& direction,
                             const std::array<dvec3, 2>& electric, std::size_t index, double wavenumber);

}  // namespace raytube
