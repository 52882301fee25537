// Edge-face interaction: waves that edges send to faces other than their own, where physical optics has none of them.
// Derived in docs/theory/interaction.md.
//
// In formulas: s' is the direction of the wave that arrives at an edge, s the one the target scatters to, beta0 the angle between
// s' and the edge, phi' and phi the azimuths of source and observer about it, from its first face on, n pi the outer angle of the
// wedge, z the position along the edge [m], k the wavenumber.
//
// A path runs from the transmitter over 0 to most_reflections plane mirrors to an edge, from there as a cone of diffracted rays
// (half angle beta0), over further mirrors, to the faces these rays meet; `most_reflections` counts both. On every face on the
// way the diffracted wave excites the current of physical optics, J = 2 n x H, which radiates unblocked.
//   edge_axes.h          which edges may illuminate others; the coordinate z
//   reflected_light.h    which parts of them a wave lights after reflections (direct light: utd/shadow)
//   ray_fan.h            rays of one azimuth, side by side along z: the faces they meet, exactly
//   edge_illumination.h  dS / d(phi) of one lit piece: the integral along z over each face is closed (utd/wedge)
//   near_illumination.h, near_row.h   the same from and to antennas at a finite distance, by quadrature
//   azimuth_cuts.h, azimuth_integral.h, illuminated_faces.h   the integral over phi
//   interaction_groups.h which edges and faces are large enough, at each frequency
//   pair_bound.h         what an edge and a face can give at most
//   pair_choice.h, illumination_rounds.h   the strongest pairs first, where a look may not take all
// To these currents come, at order 2 and 3, the fringe currents of edges lit by a wave reflected once (utd/fringe), and of the
// rims of other faces that waves of edges reach (penumbra_fringe.h).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "scene/image.h"
#include "utd/fringe/edge_scene.h"
#include "utd/interaction/edge_axes.h"
#include "utd/interaction/illuminated_faces.h"
#include "utd/interaction/pair_bound.h"
#include "utd/interaction/pair_reach.h"

namespace raytube {

/// What one look did without, for the sake of its budget.
struct InteractionSkips {
  std::uint64_t weak_pairs = 0;       // of an edge and a face: their bounds together are below the tolerance
  std::uint64_t pairs = 0;            // of an edge and a face
  std::uint64_t reflected_pairs = 0;  // of an edge and a mirror by way of which light might reach it
  std::uint64_t fringe_pieces = 0;    // pieces of edges lit by a reflected wave, whose fringe currents were left out

  InteractionSkips& operator+=(const InteractionSkips& other) {
    weak_pairs += other.weak_pairs, pairs += other.pairs;
    reflected_pairs += other.reflected_pairs, fringe_pieces += other.fringe_pieces;
    return *this;
  }
};

struct InteractionResult {
  std::vector<ScatteringMatrix> scattering;  // per frequency [m]; phase reference: centre of the mesh. Empty: nothing is lit
  std::vector<ChannelErrors> error;          // per frequency, estimated, of its quadrature [m]
  std::uint64_t illuminating_pieces = 0;     // lit pieces of edges, each once per wave that lights it

  /// Per frequency [m]: what the pairs that `skipped` counts would add to |S_pq| of the co-polar channels, by root sum of squares
  /// (docs/theory/interaction.md). Empty: nothing was left out.
  std::vector<double> left_out;
  InteractionSkips skipped{};
  std::uint64_t pairs = 0;  // of an edge and a face, computed; counted where work is limited
  double work = 0.0;        // counted (utd/wedge/work.h)
};

/// A target as diffracted waves meet it.
struct InteractionScene {
  EdgeScene edges;
  ReceivingFaces faces;                    // those that are large are mirrors, too
  std::span<const EdgeAxis> axes;          // of edges that illuminate others; into edges.wedges
  double shortest_axis = 0.0;              // of those that count [m]
  std::span<const PatchExtent> extents{};  // of the mesh's patches, and faces.by_area: needed where work is limited
  const PairReach* reach = nullptr;        // of the same edges and faces: needed for reach_of()
  double price = 0.0;                      // of a pair (pair_price.h): needed where work is limited
};

struct InteractionOptions {
  int order = 3;                                          // of the fringe currents
  double tolerance = 0.0;                                 // at which quadrature stops, as far as it can tell [m]
  double work = std::numeric_limits<double>::infinity();  // of a look by the prices of its steps, at one frequency (utd/wedge/work.h)
  const NearAntennas* antennas = nullptr;                 // at a finite distance, where S is as of these; none: plane waves
};

/// Reflections of a path from the transmitter over an edge to the last face it illuminates, before and after the edge together.
inline constexpr int most_reflections = 2;

/// S of the currents that diffracted waves excite on faces other than those of their own edge, at most one edge a path; at order
/// 2 and 3 also of the fringe currents of edges that light reaches after one reflection, and of those that waves of other edges
/// reach. Not symmetric in a monostatic look.
/// Where the work allowed is not enough for all, the strongest pairs of an edge and a face come first, by their bounds, and those
/// that together stay below the tolerance not at all. Candidates have prices known beforehand, and those as strong as the last
/// that is paid for come with it: neither their order nor the number of frequencies decides. `frequencies` [Hz] must not be
/// empty.
InteractionResult interaction_scattering(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                         const InteractionOptions& options);

/// Share of the squares expected of all pairs that the work allowed reaches, before any of them is looked at.
double reach_of(const InteractionScene& scene, const InteractionOptions& options);

/// S of interaction_scattering() at `frequencies[frequency_index]`, divided among the lit pieces of edges these waves come from;
/// or, of one frequency, into what has one place (utd/wedge/path_place.h).
std::vector<ImageEdge> interaction_pieces(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                          std::size_t frequency_index, const InteractionOptions& options, bool by_path = false);

}  // namespace raytube
