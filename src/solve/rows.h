// From looks to the rows of a sweep.
#pragma once

#include <mutex>
#include <span>

#include "plan/plan.h"
#include "solve/account.h"
#include "solve/look_result.h"
#include "solve/model_uncertainty.h"
#include "solve/physical_bound.h"

namespace raytube {

/// Root mean squares and shares of the parts of a model uncertainty from their sums of squares over so many rows [m^2], and the
/// largest part first.
void tell_shares(const std::vector<double>& sums, std::size_t rows, std::vector<ModelPart>& parts);

/// Lets go of what is kept by mechanism and by part of the model uncertainty.
void drop_parts(SweepResult& result);

/// Puts each look's result in its rows and in those of the looks that follow from it, and adds up the counts: as they come, so
/// that no look is held longer than it takes. Refers to the plan and its model uncertainty.
class Rows {
 public:
  /// `edge_lengths`: of the edges that add to S, all in all, per frequency [m].
  Rows(const SolvePlan& plan, const ModelUncertainty& model, std::vector<double> edge_lengths);

  /// The result of plan.looks.computed[index]; each once, in any order, from any thread.
  void add(std::size_t index, const LookResult& look);

  /// All of them, once all were added. Sums do not depend on the order in which they were.
  SweepResult finish();

 private:
  std::span<const std::size_t> following(std::size_t index) const;
  void add_model(std::size_t index, std::size_t frequency_index, const OmissionErrors& errors);
  void add_row(std::size_t look, std::size_t frequency_index, const LookResult& part, const LookSource& source);
  void add_to_row(std::size_t row, const ScatteringMatrix& s, std::vector<ScatteringMatrix>* rows, double bound,
                  BeyondBound& beyond);
  std::vector<ModelPart> model_parts();

  const SolvePlan& plan_;
  const Sweep& sweep_;
  const ModelUncertainty& model_uncertainty_;
  std::vector<std::size_t> first_,
      following_;  // looks that follow from computed look i: following_[first_[i] ... first_[i + 1] - 1]
  std::vector<std::array<double, omissions>> model_squares_;  // of each computed look: sums over its rows [m^2]
  std::vector<std::vector<double>> left_out_;  // [mechanism][look] squares that it left out for its budget's sake [m^2]
  Account account_;
  PhysicalBounds bounds_;
  std::vector<BeyondBound> beyond_bound_;  // first bounce, later bounces, columns of mechanisms
  SweepResult result_;
  std::mutex mutex_;
};

}  // namespace raytube
