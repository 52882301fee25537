// Which edges and faces are large enough for edge-face interaction, at each frequency.
#pragma once

#include <cstdint>
#include <vector>

#include "utd/interaction/edge_axes.h"
#include "utd/interaction/pair_plan.h"

namespace raytube {

/// Which of the materials reflect more than half of the amplitude of a wave that meets them square on, at a frequency by its
/// index.
std::vector<bool> mirrors_among(const FaceMaterials& materials, std::size_t frequency, double wavenumber);

/// The edges and faces of a target as edge-face interaction sees them at frequencies at which the same materials are mirrors.
struct InteractionParts {
  std::vector<EdgeAxis> axes;          // that may illuminate others; they point into the wedges
  std::vector<dvec3> corners;          // those of the target; none if there are more than 200
  std::vector<PatchExtent> patches;    // [patch]
  std::vector<std::uint32_t> by_area;  // those that let no waves through, the largest first

  InteractionParts() = default;
  /// `materials` are those of the mesh, at these frequencies, of which the first has this `wavenumber`; empty: perfect conductors
  /// alone.
  InteractionParts(const TriangleMesh& mesh, std::span<const Wedge> wedges, const FaceMaterials& materials, double wavenumber);
};

/// Frequencies at which the same edges and faces count.
struct InteractionGroup {
  std::vector<std::size_t> indices;  // places in the list of frequencies
  std::vector<double> frequencies;   // [Hz]
  double shortest_axis = 0.0;        // edges of a wavelength or more count [m]
  std::size_t axes = 0;              // how many such edges there are
  std::size_t large_faces = 0;       // patches of at least a wavelength squared: the first of `by_area`
  std::vector<bool> large;  // [patch], those large faces: others stand in the way, but neither receive waves nor reflect them
};

/// What of a target has no size that counts, at one frequency.
struct TooSmall {
  std::uint64_t edges = 0;  // that radiate, shorter than a wavelength
  std::uint64_t faces = 0;  // patches smaller than a wavelength squared
  double longest = 0.0;     // wavelength up to which there are an edge and a patch that are large enough [m]
};

TooSmall too_small_to_interact(const TriangleMesh& mesh, std::span<const Wedge> wedges, double frequency);

/// The groups of the `wanted` ones among the frequencies [Hz], without those at which there is nothing to illuminate.
std::vector<InteractionGroup> interaction_groups(const InteractionParts& parts, std::span<const double> frequencies,
                                                 const std::vector<bool>& wanted);

}  // namespace raytube
