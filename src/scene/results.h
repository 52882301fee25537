// What comes out of a solve: amplitudes by mechanism, counts, and what was left out. Plain data only.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Something the solver did not do, how often, and why.
struct Skipped {
  std::string what;
  std::string why;
  std::uint64_t count = 0;
};

/// Rows in which a mechanism exceeds what the size of the target allows it (solve/physical_bound.h): they are wrong.
struct BeyondBound {
  std::string part;         // the mechanism
  std::uint64_t rows = 0;   // so many
  std::uint64_t worst = 0;  // the one that exceeds it most
  double ratio = 0.0;       // of the amplitude there to its bound
};

/// What happened during a solve; every ray is accounted for.
struct Statistics {
  std::uint64_t tubes = 0;            // launched
  std::uint64_t rays = 0;             // segments traced: launched tubes and every reflected segment
  std::vector<std::uint64_t> hits;    // hits[m]: tubes that met a surface at bounce m + 1
  std::uint64_t lost_rays = 0;        // rays that met a closed body from inside (a leak); their tube ends there
  std::uint64_t tubes_truncated = 0;  // tubes that still hit a surface after max_bounces, or that curved surfaces made too wide
  double sliver_area = 0.0;      // [m^2], sum over looks: parts of adaptive tubes too thin to be more than rounding, left out
  std::uint64_t wedges = 0;      // wedges of the target, convex and concave
  std::uint64_t wedges_lit = 0;  // sum over looks of the convex wedges at least partly lit, at the highest frequency
  std::uint64_t thin_plate_edges_lowest = 0, thin_plate_edges_highest = 0;  // half planes at the lowest and the highest frequency
  std::uint64_t illuminating_pieces = 0;  // sum over looks: pieces of edges that light other surfaces, once for each wave on them
  std::uint64_t windowed_rows = 0;        // rows touched by the forward-grazing window of the fringe currents
  double ray_range = 0.0;                 // [m]: edges.method utd, amplitudes are apparent ones at this range; else 0
  std::vector<Skipped> skipped;
  std::vector<BeyondBound> beyond_bound;  // none in a sound solve
  double solve_s = 0.0;  // mesh and BVH ready -> last sum
};

/// Complex amplitudes of a sweep, one entry per row (Sweep::row), kept apart by mechanism. At a finite distance they are apparent
/// ones: what would make the same signal if it lay at the origin of the mesh's own coordinates (Antenna).
struct SweepResult {
  std::vector<ScatteringMatrix> total;  // sum of all mechanisms
  /// Estimated numerical error of |S_pq| by tubes and by edge-diffracted waves on faces [m]; not by the edges' own currents.
  std::vector<ChannelErrors> error;

  // The mechanisms; empty unless parts are kept.
  std::vector<std::vector<ScatteringMatrix>> bounces;  // bounces[m][row]: PO currents of bounce m + 1
  std::vector<ScatteringMatrix> edges_first;           // fringe currents of the lit wedges
  std::vector<ScatteringMatrix> edges_higher;          // what these currents start at further wedges
  std::vector<ScatteringMatrix> interaction;           // currents that edge-diffracted waves excite on other surfaces

  std::vector<std::array<double, 2>> incoherent;  // sigma of rough surfaces for transmitted V and H [m^2]; empty: there are none
  Statistics statistics;
};

}  // namespace raytube
