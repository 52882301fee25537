// What is asked (Sweep) and what comes back (SweepResult): plain data only.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "scene/antenna.h"
#include "scene/material.h"

namespace raytube {

/// A pair of directions from the target: to the transmitter and to the receiver (equal for a monostatic look), and how far these
/// are from the origin of the mesh's own coordinates [m]: both at a finite distance, or neither.
struct Look {
  Direction transmit;
  Direction receive;
  double transmit_range = std::numeric_limits<double>::infinity();
  double receive_range = std::numeric_limits<double>::infinity();

  bool far() const { return std::isinf(transmit_range); }
};

/// Transmitter and receiver of a look from a finite distance, in recentred coordinates. Keeps references to the pattern.
struct AntennaPair {
  AntennaPair(const Look& look, const Radar& radar, const dvec3& mesh_center)
      : transmit({look.transmit, look.transmit_range}, -mesh_center, radar.aim - mesh_center, radar.pattern),
        receive({look.receive, look.receive_range}, -mesh_center, radar.aim - mesh_center, radar.pattern) {}
  Antenna transmit, receive;
};

/// Every look at every frequency. Rows of the result: looks vary slowest, frequency fastest.
struct Sweep {
  std::vector<double> frequencies;  // [Hz], > 0
  std::vector<Look> looks;
  bool bistatic = false;  // receive directions were given (they may still coincide); else every look is its own receiver
  Radar radar{};          // of looks from a finite distance
  std::vector<Material> materials{};  // of the target: see Patch::material

  std::size_t rows() const { return frequencies.size() * looks.size(); }
  std::size_t row(std::size_t look, std::size_t frequency) const { return look * frequencies.size() + frequency; }
};

/// Something the solver did not do, how often, and why.
struct Skipped {
  std::string what;
  std::string why;
  std::uint64_t count = 0;
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
  double solve_s = 0.0;  // mesh and BVH ready -> last sum
};

/// Complex amplitudes of a sweep, one entry per row (Sweep::row), kept apart by mechanism. At a finite distance they are apparent
/// ones: what would make the same signal if it lay at the origin of the mesh's own coordinates (Antenna).
struct SweepResult {
  std::vector<ScatteringMatrix> total;  // sum of all mechanisms
  std::vector<ChannelErrors>
      error;  // estimated numerical error of |S_pq| by tubes and painted waves [m]; not by the edges' own currents
  std::vector<std::vector<ScatteringMatrix>>
      bounces;  // bounces[m][row]: PO currents of bounce m + 1; empty unless parts are kept
  // Fringe currents of the lit wedges, and what these currents start at further wedges; empty unless parts are kept.
  std::vector<ScatteringMatrix> edges_first, edges_higher;
  std::vector<std::array<double, 2>> incoherent;  // sigma of rough surfaces for transmitted V and H [m^2]; empty: there are none
  std::vector<ScatteringMatrix>
      interaction;  // currents that edge-diffracted waves excite on other surfaces; empty unless parts are kept
  Statistics statistics;
};

}  // namespace raytube
