// What mechanisms add to one look.
#pragma once

#include <cstdint>
#include <vector>

#include "core/field.h"
#include "scene/image.h"
#include "scene/mechanisms.h"
#include "scene/skipped.h"
#include "scene/surface_rays.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

/// Mechanisms beside the tubes, in the order in which they run.
enum class MechanismId : std::uint8_t { surface_waves, edge_currents, interaction };
inline constexpr std::size_t mechanism_count = 3;

/// How a mechanism fared in one look.
struct MechanismRun {
  std::vector<bool> ran{};  // [frequency]; empty: at none
  double most_db = 0.0;     // by which it was expected to move a co-polar row at most, where it did not run [dB]
  double work = 0.0;        // counted (core/work.h)
  double reach = 1.0;       // share of what is expected of it that its budget allows, where that was too little
  bool out_of_reach() const { return reach < 1.0; }
};

/// One look, all frequencies, phase reference as of the tubes.
struct LookSums {
  ByPart<std::vector<ScatteringMatrix>> s;  // [Part][frequency]; empty: nothing is added
  std::vector<ChannelErrors> error{};       // [frequency] estimated, of quadrature [m]; empty: none
  std::vector<double> left_out{};           // [frequency] of edge-face interaction, for its budget's sake [m]; empty: nothing
  std::array<MechanismRun, mechanism_count> runs{};  // [MechanismId]
  SkipCounts skipped{};
  std::uint64_t wedges_lit = 0, surface_strips = 0, illuminating_pieces = 0;  // as of Statistics
  std::uint64_t interaction_pairs = 0;                                        // of an edge and a face, computed
  std::vector<bool> windowed{};  // [frequency] the forward-grazing window of edge currents changed the sum
  bool edges_lit = false;        // any edge radiates

  MechanismRun& run(MechanismId id) { return runs[static_cast<std::size_t>(id)]; }
  const MechanismRun& run(MechanismId id) const { return runs[static_cast<std::size_t>(id)]; }
};

/// Where the pieces of an image go.
struct ImageRequest {
  std::size_t frequency_index;  // among those of the look
  const ImageLattice& lattice;  // in recentred coordinates
  bool by_path = false;         // pieces stand where their paths have their place (scene/scattering_piece.h); of one frequency
  std::vector<ImageEdge> pieces{};
  std::vector<MechanismId> mechanisms{};  // of the pieces
};

/// Takes what one mechanism after the other adds.
struct LookSink {
  LookSums sums{};
  std::vector<SurfaceArrival> arrivals{};  // waves over curved surfaces at wedges, which edge currents carry on
  ImageRequest* image = nullptr;           // null: none is asked for
};

}  // namespace raytube
