// The light on the edges of a target in one look, direct and reflected.
#pragma once

#include <deque>
#include <vector>

#include "utd/fringe/edge_scene.h"
#include "utd/fringe/reflected_edges.h"
#include "utd/interaction/edge_axes.h"
#include "utd/interaction/reflected_light.h"

namespace raytube {

/// Reflections of a path from the transmitter over an edge to the last face it illuminates, before and after the edge together.
inline constexpr int most_reflections = 2;

/// A target as diffracted waves meet it.
struct InteractionScene {
  EdgeScene edges;
  ReceivingFaces faces;                    // those that are large are mirrors, too
  std::span<const EdgeAxis> axes;          // those of edges that illuminate others; into edges.wedges
  double shortest_axis = 0.0;              // the shortest axis that counts [m]
  std::span<const PatchExtent> extents{};  // [patch]; needed where the plan has not all pairs
  const PairPlan& plan = all_pairs;        // pairs of these axes and faces
};

/// A lit piece of an edge, and what its waves may do.
struct LitJob {
  const LitEdgePiece* piece;
  int reflections;                 // after the edge
  const ReflectedWave* reflected;  // what lights it; null: the incident wave

  bool has_penumbra() const { return reflections > 0; }
};

/// Pieces and jobs point into it.
struct EdgeLight {
  /// Keeps a reference to the scene; `antennas` at a finite distance, or none.
  EdgeLight(const InteractionScene& scene, const Look& look, std::span<const double> frequencies, const NearAntennas* antennas);
  EdgeLight(const EdgeLight&) = delete;

  std::size_t axis_of(const LitEdgePiece& piece) const { return static_cast<std::size_t>(piece.edge - scene.axes.data()); }
  PathPlace place_of(std::span<const std::uint32_t> mirrors) const;
  PathPlace place_of(const LitJob& job) const;
  /// The looks in which a wave lights some of its pieces: one, or of antennas at a finite distance one for every part of a piece
  /// along which their waves are plane.
  std::vector<ReflectedLook> looks_of(const ReflectedWave& wave, std::span<const LitEdgePiece> pieces) const;

  const InteractionScene& scene;
  LookVectors look;  // that of the middle of the mesh
  PlaneWave incident;
  std::vector<double> wavenumbers;  // [rad/m]
  double wavelength;                // the shortest [m]
  std::vector<LitEdgePiece> direct;
  std::deque<ReflectedWave> reflected;
  std::vector<LitJob> jobs;
  double work = 0.0;                 // counted (utd/wedge/work.h)
  std::uint64_t pairs_left_out = 0;  // pairs of an edge and a sequence of mirrors

 private:
  void find_direct();
  void find_reflected();
  void weigh_by_surfaces(ReflectedWave& wave) const;
  std::uint32_t wedge_of(const EdgeAxis& axis) const;
};

}  // namespace raytube
