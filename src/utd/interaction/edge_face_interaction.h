// Edge-face interaction: waves that edges send to faces other than their own, where physical optics has none of them.
// Derived in docs/theory/interaction.md.
//
// Notation: s' is the direction of the wave that arrives at an edge, s the one the target scatters to, beta0 the angle between
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
//   pair_plan.h          the strongest pairs of an edge and a face, where not all are paid for
//   edge_light.h         all light on edges in one look
// To these currents come, at order 2 and 3, the fringe currents of edges lit by a wave reflected once (utd/fringe), and of the
// rims of other faces that waves of edges reach (penumbra_fringe.h).
#pragma once

#include <cstdint>
#include <vector>

#include "utd/interaction/edge_light.h"

namespace raytube {

struct InteractionResult {
  std::vector<ScatteringMatrix> scattering;  // per frequency [m]; phase reference: centre of the mesh. Empty: nothing is lit
  std::vector<ChannelErrors> error;          // per frequency, estimated, of its quadrature [m]
  std::uint64_t illuminating_pieces = 0;     // lit pieces of edges, each once per wave that lights it

  /// Per frequency [m]: what pairs of an edge and a face that are not paid for would add to |S_pq| of the co-polar channels, by
  /// root sum of squares (docs/theory/interaction.md). Empty: none are left out.
  std::vector<double> left_out;
  std::uint64_t pairs = 0, pairs_left_out = 0;  // pairs of an edge and a face, as the plan has them
  std::uint64_t reflected_pairs_left_out = 0;   // pairs of an edge and mirrors by way of which light might reach it
  double work = 0.0;                            // counted (utd/wedge/work.h)
};

struct InteractionOptions {
  int order = 3;                           // order of the fringe currents
  double tolerance = 0.0;                  // error at which quadrature stops, as far as it can tell [m]
  const NearAntennas* antennas = nullptr;  // at a finite distance, where S is as of these; none: plane waves
};

/// S of the currents that diffracted waves excite on faces other than those of their own edge, at most one edge a path; at order
/// 2 and 3 also of the fringe currents of edges that light reaches after one reflection, and of those that waves of other edges
/// reach. Not symmetric in a monostatic look.
/// `frequencies` [Hz] must not be empty.
InteractionResult interaction_scattering(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                         const InteractionOptions& options);

/// How S is divided: not at all, among the lit pieces of edges these waves come from, or into what has one place
/// (utd/wedge/path_place.h).
enum class InteractionApart { none, by_edges, by_path };

/// S of interaction_scattering() at one frequency [Hz], in pieces.
std::vector<ImageEdge> interaction_pieces(const InteractionScene& scene, const Look& look, double frequency,
                                          const InteractionOptions& options, InteractionApart apart);

/// Bytes that one look under way takes at most, for so many frequencies.
double interaction_bytes(std::size_t frequencies);

}  // namespace raytube
