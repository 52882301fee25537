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

/// Waves from corner to corner (utd/corner) along one edge.
struct CornerWaveGroup {
  std::uint32_t wedge;
  std::vector<LitInterval> lit;  // parts of it behind the same screens; the waves count in proportion
  const Screens& screens;
  dvec3 middle;
  double part;  // of the whole edge, of which this wedge may be a part, that the wedge is
};

/// How much of an edge its lit parts are.
double share_of(std::span<const LitInterval> lit);

/// One look at the edges of a target. Keeps references to its arguments.
class EdgesInLook {
 public:
  EdgesInLook(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset, const FringeOptions& options);

  /// Visits all lit parts: from infinity those of all edges together, by their screens; else piece by piece of each edge. Returns
  /// how many edges are lit but for those of which only a plate's edge face is.
  std::uint64_t visit_groups(const std::function<void(const EdgeGroup&)>& visit);

  /// Visits all edges that have waves from corner to corner and are lit, or their corners are.
  void visit_corner_waves(const std::function<void(const CornerWaveGroup&)>& visit);

  /// S [m] of the waves along a whole edge added up at the frequencies, behind no screens.
  void add_corner_waves(std::uint32_t wedge, double share, std::span<const double> frequencies,
                        std::span<ScatteringMatrix> sum) const;

  /// What is S of a point without screens becomes that behind these, at one of the frequencies.
  ScatteringMatrix behind(const Screens& screens, const dvec3& point, ScatteringMatrix s, std::size_t frequency) const;
  /// S of a group as the receiver finds it.
  ScatteringMatrix received(const EdgeGroup& group, const ScatteringMatrix& s, std::size_t frequency) const;

  /// Counted (utd/wedge/work.h).
  double work() const { return work_; }

 private:
  std::vector<ScreenedInterval> parts_of(const Wedge& wedge, std::span<const LitInterval> lit) const;
  std::vector<LitInterval> lit_between_corners(std::uint32_t index);
  double share_between_corners(const SolidEdge& edge, const dvec3& incident);

  const EdgeScene& scene_;
  const EdgeLook& look_;
  SweepSubset subset_;
  int order_;
  LitEdges light_;
  std::optional<ScreenCutter> cutter_;  // if there are screens
  double work_ = 0.0;
};

}  // namespace raytube
