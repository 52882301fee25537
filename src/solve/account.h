// What happened in a solve, in counts and in words.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "plan/plan.h"
#include "solve/look_result.h"

namespace raytube {

/// Adds up the counts of looks. Refers to the plan.
class Account {
 public:
  explicit Account(const SolvePlan& plan);

  /// Computed look `index`, from which so many looks of the sweep follow, itself among them. In any order, one at a time.
  void add(std::size_t index, const LookResult& look, std::size_t following);

  /// The statistics, complete but for `beyond_bound` and the time; called once, last.
  Statistics finish();

  /// What one mechanism did and left out so far.
  const std::vector<Count>& counts(std::size_t mechanism) const { return mechanisms_[mechanism].counts; }
  const MechanismUse& use(std::size_t mechanism) const { return mechanisms_[mechanism].use; }
  const Statistics& so_far() const { return all_; }

 private:
  struct MechanismSums {
    std::vector<Count> counts{};
    MechanismUse use{};         // in computed looks
    std::uint64_t beyond = 0;   // looks of the sweep that its budget does not reach
    std::uint64_t without = 0;  // looks of the sweep without it for another reason
    double most_reach = 0.0;    // share of what is expected of it, in the looks beyond its budget
  };
  void add_tubes(std::size_t index, const TubeSums& tubes);
  void tell_tubes();
  void tell_counts(const std::vector<Count>& counts);
  void tell_mechanism(const MechanismEntry& mechanism, const MechanismState& state, const MechanismSums& sums);
  void tell_lost_rays();

  const SolvePlan& plan_;
  Statistics all_;
  std::vector<Count> tube_counts_;
  std::vector<MechanismSums> mechanisms_;
  std::vector<double> sliver_areas_;                       // of each computed look: the one count whose sum depends on its order
  std::map<std::size_t, std::vector<LostRay>> lost_rays_;  // of each computed look with any, the first ones
};

}  // namespace raytube
