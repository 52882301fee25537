// From looks to the rows of a sweep.
#pragma once

#include <mutex>

#include "scene/skipped.h"
#include "solve/look_result.h"
#include "solve/solve.h"

namespace raytube {

/// Puts each look's result in its rows and in those of the looks that follow from it, and adds up the counts: as they come, so
/// that no look is held longer than it takes. Keeps references to all it is given.
class RowCollector {
 public:
  RowCollector(const Target& target, const Sweep& sweep, const SolveOptions& options, const LookPlan& plan);

  /// The result of plan.computed[place]; each once, in any order, from any thread.
  void add(std::size_t place, const LookResult& look);

  /// All of them, once all were added. Sums do not depend on the order in which they were.
  SweepResult finish(const std::vector<bool>& above_limit);

 private:
  void count(std::size_t place, const LookResult& look);
  void add_rows(std::size_t look, const LookResult& part, const LookSource& source);
  void add_row(std::size_t look, std::size_t f, const LookResult& part, const LookSource& source);
  void add_interaction(std::size_t row, std::size_t f, const LookResult& part, const LookSource& source, Complex factor);
  void add_edges(std::size_t row, const ScatteringMatrix& edges, std::vector<ScatteringMatrix>& part);
  void count_spared_by_shape();
  void count_thin_plate_edges();

  const Target& target_;
  const Sweep& sweep_;
  const SolveOptions& options_;
  const LookPlan& plan_;
  std::vector<std::size_t> first_, following_;  // looks that follow from place i: following_[first_[i]...first_[i + 1] - 1]
  std::vector<double> sliver_areas_;            // of each place: the one count whose sum depends on its order
  std::uint64_t looks_without_tubes_ = 0;
  SkipCounts skipped_;
  SweepResult result_;
  std::mutex mutex_;
};

}  // namespace raytube
