// The lit parts of edges in one look, by the waves that they meet and by the screens that they stand behind.
#pragma once

#include <functional>

#include "utd/fringe/edge_look.h"
#include "utd/fringe/edge_sum.h"
#include "utd/fringe/screens.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

/// Parts of edges that meet the same plane waves, and whose S changes in the same way before it gets to the receiver.
struct EdgeGroup {
  LookVectors look;
  double path;             // added to the phases that the waves of `look` have [m]
  const Screens& screens;  // what stands before the antennas
  dvec3 middle;            // where these are taken
  std::vector<LitEdge> edges;
};

/// What an image asks of edges. The lattice is kept by reference.
struct PieceRequest {
  std::size_t frequency_index;  // among the frequencies of the look, which choose the points along the edges together
  const ImageLattice& lattice;
  bool by_path = false;  // begin = end = where the wave's path has its place, of one frequency; else where the edge is lit
};

/// The lit parts of an edge, cut where it goes from one cell into another.
std::vector<LitInterval> cut_at_cells(const Wedge& wedge, std::span<const LitInterval> lit, const ImageLattice& lattice);

/// How much of an edge its lit parts are.
double share_of(std::span<const LitInterval> lit);

/// One look at the edges of a target. Keeps references to its arguments.
class EdgesInLook {
 public:
  EdgesInLook(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset, const FringeOptions& options);

  /// Visits all lit parts: from infinity those of all edges together, by their screens; else piece by piece of each edge. Returns
  /// how many edges are lit but for those of which only a plate's edge face is.
  std::uint64_t visit_groups(const std::function<void(const EdgeGroup&)>& visit);

  /// The parts of wedge `index` that are lit in a wave that meets it like that, each with its screens.
  std::vector<ScreenedInterval> lit_parts(std::uint32_t index, const WedgeIncidence& incidence);

  /// Parts of wedge `index`, each with its screens.
  std::vector<ScreenedInterval> behind_screens(std::uint32_t index, std::span<const LitInterval> parts) const;

  /// What is S of a point without screens becomes that behind these, at one of the frequencies.
  ScatteringMatrix behind(const Screens& screens, const dvec3& point, ScatteringMatrix s, std::size_t frequency) const;
  /// S of a group as the receiver finds it.
  ScatteringMatrix received(const EdgeGroup& group, const ScatteringMatrix& s, std::size_t frequency) const;

  /// Counted (utd/wedge/work.h).
  double work() const { return work_; }

 private:
  const EdgeScene& scene_;
  const EdgeLook& look_;
  SweepSubset subset_;
  const FringeOptions& options_;
  LitEdges light_;
  std::optional<ScreenCutter> cutter_;  // if there are screens
  double work_ = 0.0;
};

}  // namespace raytube
