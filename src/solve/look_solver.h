// The mechanisms of a look, one after the other.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "sbr/sbr.h"
#include "solve/look_result.h"
#include "solve/plan.h"
#include "uncertainty/surface_wave_prospect.h"
#include "utd/edge_sets.h"
#include "utd/gtd/ray_fields.h"

namespace raytube {

/// A budget of edge-face interaction from which on it has no limit, and nothing is left out.
inline constexpr double unlimited_interaction_budget = 1e6;

/// Of the progress of a look, what is told as its tubes go on for the first time: they may be refined, and edges follow.
inline constexpr double first_tubes_share = 0.5;

/// What a look is at, in this order; waves over curved surfaces count with the edges.
enum class LookStage { tubes, edges, interaction };

/// Computes the looks of a plan. What all looks share is made once. Refers to the plan. Thread-safe.
class LookSolver {
 public:
  explicit LookSolver(const SolvePlan& plan);
  LookSolver(const LookSolver&) = delete;

  /// All mechanisms of look `index` of the sweep at every frequency, phase reference at the centre of the mesh (at a finite
  /// distance: the origin of its coordinates). Adds `share` to `progress` by and by. Tells when a stage
  /// after the first `begins`.
  LookResult solve(std::size_t index, Progress& progress, double share, const std::function<void(LookStage)>& begins = {}) const;

  /// The tubes alone; `map` takes their currents at one frequency, with where on the target they are.
  TubeSums tubes(const Look& look, Progress& progress, CurrentMap& map) const;

  /// Whether edges are asked for their fringe currents.
  bool edges_count() const { return edges_count_; }
  const EdgeSets& edges() const { return edges_; }

  /// How long all edges that may add to S are together, per frequency [m].
  std::vector<double> edge_lengths() const;

  /// Surface waves of a look with these tubes at one frequency, point by point; none if they do not count.
  std::vector<ImageEdge> surface_pieces(const Look& look, const TubeSums& tubes, std::size_t frequency_index) const;

  /// The rays over curved surfaces of a look at the first frequency, in the mesh's own coordinates; none if they do not count.
  /// Their points are a tenth of the wavelength apart, or more.
  std::vector<SurfaceRay> surface_rays(const Look& look) const;

  /// Counted work of the edges of a look (core/work.h).
  double edge_work(const Look& look) const { return edges_of(look, {}).work; }
  /// What edge-face interaction may leave and take beside these tubes and edges, whose counted work is given (core/work.h).
  InteractionLimits interaction_limits(const TubeSums& tubes, double edge_work) const;

 private:
  LookResult rays(const Look& look, Progress& progress, double share) const;
  bool surface_waves_count(const Look& look, const TubeSums& tubes) const;
  EdgeLookResult edges_of(const Look& look, std::span<const SurfaceArrival> arrivals) const;
  InteractionResult interaction(const Look& look, const LookResult& others) const;
  double interaction_tolerance(const TubeSums& tubes) const;

  const SolvePlan& plan_;
  TubeScene tube_scene_;
  std::optional<CurvedTarget> curved_;           // if surface waves count
  std::optional<SurfaceWaveProspect> prospect_;  // if they do so only in some looks
  EdgeSets edges_;
  bool edges_count_;
  std::optional<RayFields> ray_fields_;
};

}  // namespace raytube
