// Waves from corner to corner (utd/corner) along the edges of a target in one look.
#pragma once

#include "utd/fringe/edge_groups.h"

namespace raytube {

/// What they add to S.
struct CornerWaveSum {
  std::vector<ScatteringMatrix> scattering;  // per frequency [m]
  std::uint64_t edges = 0;                   // wedges and thin ends along which they run in this look
  double work = 0.0;                         // counted (utd/wedge/work.h)
};

/// S of the waves of one kind along all edges that are lit, in proportion to their lit parts, and along edges of solids between
/// two dark faces whose corners are lit. An end of a thin body counts once, whatever wedges it is of; behind screens a wave is
/// transformed by what these let through at the middle of its wedge. `scene.corners` must be there, and `subset.frequencies` [Hz]
/// not be empty.
CornerWaveSum corner_wave_scattering(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                     const FringeOptions& options, CornerWaveKind kind);

/// Estimate of what the waves along all edges of solids whose corners see the antennas past their own body add to |S| at most at
/// each frequency [m], without solving their corners: of edges that run alike by the phases of their waves, of others as if these
/// were independent.
std::vector<double> solid_corner_amplitudes(const EdgeScene& scene, const EdgeLook& look, std::span<const double> frequencies);

/// The waves of one kind at one of the frequencies, spread over the lit parts of each edge by length; or each at the place of its path.
std::vector<ImageEdge> corner_wave_pieces(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                          const PieceRequest& request, const FringeOptions& options, CornerWaveKind kind);

}  // namespace raytube
