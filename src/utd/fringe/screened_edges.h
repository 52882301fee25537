// Edges behind sheets that let waves through: lit through them, and seen through them.
#pragma once

#include "scene/material.h"
#include "utd/fringe/edges.h"

namespace raytube {

/// The opaque surfaces of a target and its sheets, each as if the others were not there. `mesh` and `materials` must outlive it.
class OpaqueAndScreens {
 public:
  OpaqueAndScreens(const TriangleMesh& mesh, std::span<const Material> materials);
  OpaqueAndScreens(const OpaqueAndScreens&) = delete;

  const Tracer& opaque() const { return opaque_; }

  /// The patches of the sheets that stand between a place and the antenna in this direction, nearest first.
  std::vector<std::uint32_t> before(const dvec3& place, const dvec3& direction) const;
  const dvec3& normal(std::uint32_t patch) const { return sheet_mesh_.patches[patch].normal; }
  const Material& material(std::uint32_t patch) const { return materials_[sheet_mesh_.patches[patch].material]; }

 private:
  TriangleMesh opaque_mesh_, sheet_mesh_;
  Tracer opaque_, sheets_;
  std::span<const Material> materials_;
};

/// fringe_scattering() where opaque surfaces cast shadows and sheets do not: parts of edges behind the same sheets, for both
/// antennas, are taken together, and what they radiate is transformed by what these let through along both lines of sight. An
/// edge's part changes its sheets to within 1e-9 of its length; sheets that cover less than the spacing of the points at which
/// Visibility looks may be missed. `places` are those of the frequencies among the materials'. Valid as T of the plane waves is:
/// far from the sheets' own rims. What a current starts at another edge has the sheets of its own edge, wherever that one is.
EdgeLookResult screened_fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines, const OpaqueAndScreens& target,
                                          const Look& look, std::span<const double> frequencies,
                                          std::span<const std::size_t> places, int order, bool receiver_shadow,
                                          TransitionTier tier);

/// The same currents at `frequencies[frequency]`, piece by piece: see fringe_pieces.
std::vector<ImageEdge> screened_fringe_pieces(std::span<const Wedge> wedges, const Outlines& outlines,
                                              const OpaqueAndScreens& target, const Look& look,
                                              std::span<const double> frequencies, std::size_t frequency, std::size_t place,
                                              int order, bool receiver_shadow, TransitionTier tier, const ImageLattice& lattice);

}  // namespace raytube
