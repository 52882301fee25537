// Edges behind screens: sheets that let waves through, before the transmitter, the receiver or both.
#pragma once

#include <span>
#include <vector>

#include "scene/material.h"
#include "utd/fringe/fringe_pieces.h"

namespace raytube {

/// The opaque surfaces of a target and its screens, each as if the others were not there. `materials` must outlive it.
class OpaqueAndScreens {
 public:
  OpaqueAndScreens(const TriangleMesh& mesh, std::span<const Material> materials);
  OpaqueAndScreens(const OpaqueAndScreens&) = delete;

  const Tracer& opaque() const { return opaque_; }

  /// The patches of the screens that stand between a point and the antenna in this direction, nearest first.
  std::vector<std::uint32_t> before(const dvec3& point, const dvec3& direction) const;
  const dvec3& normal(std::uint32_t patch) const { return screen_mesh_.patches[patch].normal; }
  const Material& material(std::uint32_t patch) const { return materials_[screen_mesh_.patches[patch].material]; }

 private:
  TriangleMesh opaque_mesh_, screen_mesh_;
  Tracer opaque_, screens_;
  std::span<const Material> materials_;
};

/// Some of the frequencies of a sweep.
struct SweepSubset {
  std::span<const double> frequencies;   // [Hz]
  std::span<const std::size_t> indices;  // of each in the sweep, as materials are tabulated
};

/// fringe_scattering() where opaque surfaces cast shadows and screens do not; the tracer of `scene` is target.opaque(). Parts of
/// edges behind the same screens, for both antennas, are taken together, and what they radiate is transformed by what these let
/// through along both lines of sight. Where an edge changes its screens is found to within 1e-9 of its length; screens that
/// cover less than the spacing of the points at which EdgeVisibility tests may be missed. Valid as T of the plane waves is: far
/// from the screens' own edges. What a current starts at another edge has the screens of its own edge, wherever that one is.
EdgeLookResult screened_fringe_scattering(const EdgeScene& scene, const OpaqueAndScreens& target, const Look& look,
                                          const SweepSubset& subset, const FringeOptions& options);

/// fringe_pieces() behind screens: of the currents of screened_fringe_scattering().
std::vector<ImageEdge> screened_fringe_pieces(const EdgeScene& scene, const OpaqueAndScreens& target, const Look& look,
                                              const SweepSubset& subset, const PieceRequest& request,
                                              const FringeOptions& options);

}  // namespace raytube
