// What happened in a solve, in counts and in words.
#pragma once

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

  /// Everything but `beyond_bound` and the time.
  Statistics finish();

  const std::vector<Count>& counts() const { return counts_; }
  const Statistics& so_far() const { return all_; }
  const std::vector<MechanismUse>& used() const { return used_; }

 private:
  void add_tubes(std::size_t index, const TubeSums& tubes);
  void add_count(const Count& count, std::size_t looks);
  void tell_tubes();
  void tell_mechanism(std::size_t mechanism);
  void tell_lost_rays();

  const SolvePlan& plan_;
  Statistics all_;
  std::vector<Count> counts_;                              // of tubes and mechanisms
  std::vector<MechanismUse> used_;                         // [mechanism]
  std::vector<std::uint64_t> beyond_;                      // [mechanism] looks that its budget does not reach
  std::vector<double> most_reach_;                         // [mechanism] of what is expected of it, in these looks
  std::vector<double> sliver_areas_;                       // of each computed look: the one count whose sum depends on its order
  std::map<std::size_t, std::vector<LostRay>> lost_rays_;  // of each computed look with any, the first ones
};

}  // namespace raytube
