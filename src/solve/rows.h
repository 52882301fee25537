// From looks to the rows of a sweep.
#pragma once

#include <map>
#include <mutex>

#include "plan/plan.h"
#include "scene/skipped.h"
#include "solve/look_result.h"
#include "solve/mechanisms/state.h"
#include "solve/model_uncertainty.h"
#include "solve/physical_bound.h"

namespace raytube {

/// Puts each look's result in its rows and in those of the looks that follow from it, and adds up the counts: as they come, so
/// that no look is held longer than it takes. Refers to the plan and its model uncertainty.
class RowCollector {
 public:
  /// `edge_lengths`: of the edges that add to S, all in all, per frequency [m].
  RowCollector(const SolvePlan& plan, const ModelUncertainty& model, std::vector<double> edge_lengths);

  /// The result of plan.looks.computed[index]; each once, in any order, from any thread.
  void add(std::size_t index, const LookResult& look);

  /// All of them, once all were added. Sums do not depend on the order in which they were.
  SweepResult finish();

 private:
  void count(std::size_t index, const LookResult& look);
  void count_tubes(std::size_t index, const TubeSums& tubes);
  void count_runs(const LookSums& look);
  void add_model(std::size_t index, std::size_t frequency_index, const OmissionErrors& errors);
  void finish_model();
  void add_rows(std::size_t look, const LookResult& part, const LookSource& source);
  void add_row(std::size_t look, std::size_t frequency_index, const LookResult& part, const LookSource& source);
  void compare(std::size_t part, std::size_t row, const ScatteringMatrix& s, double bound);
  void tell_lost_rays();
  void tell_mechanisms();
  void count_thin_plate_edges();

  const SolvePlan& plan_;
  const Sweep& sweep_;
  const ModelUncertainty& model_uncertainty_;
  std::vector<std::size_t> first_,
      following_;                     // looks that follow from computed look i: following_[first_[i]...first_[i + 1] - 1]
  std::vector<double> sliver_areas_;  // of each computed look: the one count whose sum depends on its order
  std::vector<std::array<double, omissions>> model_squares_;  // of each computed look: sums over its rows, too [m^2]
  std::map<std::size_t, std::vector<LostRay>> lost_rays_;     // of each computed look with any, the first ones
  // Of each computed look: sum over its rows of the squares of edge-face interaction left out for the sake of its budget [m^2].
  std::vector<double> interaction_left_out_;
  std::uint64_t interaction_pairs_ = 0;
  std::vector<MechanismState> states_;  // [MechanismId]
  std::vector<MechanismUse> used_;      // [MechanismId]
  std::uint64_t unreached_looks_ = 0, dark_interaction_looks_ = 0;
  double most_reach_ = 0.0;  // of what is expected of interaction, in the looks that its budget does not reach
  std::uint64_t looks_without_tubes_ = 0;
  SkipCounts skipped_;
  PhysicalBounds bounds_;
  std::vector<BeyondBound> beyond_bound_;  // of each part
  SweepResult result_;
  std::mutex mutex_;
};

}  // namespace raytube
