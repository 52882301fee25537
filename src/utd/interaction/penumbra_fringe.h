// Penumbra fringe: the wave that one edge diffracts reaches the rims of other faces, where its current of physical optics ends;
// the fringe current of those rims belongs to it. Derived in docs/theory/interaction.md.
#pragma once

#include <optional>
#include <vector>

#include "math/node_waves.h"
#include "mesh/trace/tracer.h"
#include "utd/interaction/pair_plan.h"
#include "utd/wedge/diffracted_field.h"

namespace raytube {

/// What the rims of other faces make of the waves of lit pieces of edges, in one look. Keeps references to its arguments.
class PenumbraFringe {
 public:
  /// `faces` and `tracer` are of one mesh. `axes` are the edges that waves of others may reach, sources among them; those shorter
  /// than `shortest_axis` [m] do not count, nor rims of faces that make no pair of the plan with a source.
  PenumbraFringe(const Tracer& tracer, const FaceTree& faces, std::span<const EdgeAxis> axes, double shortest_axis,
                 const LookVectors& look, std::span<const double> wavenumbers, const PairPlan& plan = all_pairs);

  /// Adds S [m] of all rims that the waves of `source` reach, per wavenumber.
  void add(const LitEdgePiece& source, std::vector<ScatteringMatrix>& sums);

  /// Appends S at the only wavenumber, point by point of the rims, to `pieces`. Not counted.
  void take_apart(const LitEdgePiece& source, const PathPlace& place, std::vector<ImageEdge>& pieces) const;

  /// Adds what such a current of the edge of `lit` itself is under its own wave, times `weight`: the wave over another edge
  /// completes reflected light that ends at the border of its beam.
  void add_step(const LitEdgePiece& lit, double weight, std::vector<ScatteringMatrix>& sums) const;

  /// Whether the wave of `source` meets the middle of `lit` on the boundary at which this light ends, as close as add() tells.
  bool ends_along(const LitEdgePiece& lit, const LitEdgePiece& source) const;

  /// Counted so far (utd/wedge/work.h).
  double work() const { return work_; }

 private:
  struct Source;
  struct Rim;
  struct Way;
  Way way_over(const Source& source, const EdgeRay& ray, const dvec3& place) const;
  struct ArrivingWave;
  struct RimPoint;
  struct Panel;
  template <class Visit>
  void visit_rims(const Source& source, Visit visit) const;
  void add_rim(const Source& source, const Rim& rim, std::vector<ScatteringMatrix>& sums);
  std::size_t add_panel(const Source& source, const Panel& panel, std::vector<ScatteringMatrix>& sums);
  std::optional<Panel> panel_on(const Source& source, const Rim& rim, double from, double to) const;
  std::optional<RimPoint> point_on(const Source& source, const Rim& rim, const dvec3& place) const;
  bool is_clear(const Source& source, const EdgeRay& ray, const Rim& rim, const dvec3& place) const;
  std::vector<double> panels_of(const Source& source, const Rim& rim) const;
  static double work_of_panel(std::size_t frequencies);
  const ChebyshevNodes* nodes_of(double half_span);

  const Tracer& tracer_;
  const FaceTree& faces_;
  std::span<const EdgeAxis> axes_;
  double shortest_axis_;
  const LookVectors& look_;
  std::span<const double> wavenumbers_;
  const PairPlan& plan_;
  Band band_;
  double shortest_wavelength_;
  double work_ = 0.0;
};

}  // namespace raytube
