#include "solve/account.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "solve/mechanisms/mechanism.h"

namespace raytube {

Account::Account(const SolvePlan& plan)
    : plan_(plan),
      tube_counts_{{"tubes", "empty cells of the grid"},
                   {"faces in a look", "turned away from the transmitter"},
                   {"tubes of a look", "the target has no projected area"}},
      sliver_areas_(plan.looks.computed.size()) {
  for (std::size_t i = 0; i < plan.mechanisms.size(); ++i) {
    const MechanismEntry& entry = plan.mechanisms[i];
    const MechanismState& state = plan.states[i];
    mechanisms_.push_back({.use = {entry.name, entry.label, entry.key, state.on, state.why_not}});
    for (const char* name : entry.counts) mechanisms_.back().counts.push_back({name});
  }
}

void Account::add(std::size_t index, const LookResult& look, std::size_t following) {
  add_tubes(index, look.tubes);
  if (look.tubes.tubes == 0 && !plan_.rays()) tube_counts_[2].count += following;
  for (std::size_t i = 0; i < look.mechanisms.size(); ++i) {
    const Contribution& part = look.mechanisms[i];
    MechanismSums& sums = mechanisms_[i];
    for (const Count& count : part.counts)
      if (!part.out_of_reach() || count.fold != Fold::least) put({count.what, count.why, count.count * following}, sums.counts);
    if (!plan_.states[i].on) continue;
    ++(part.ran.empty() || part.out_of_reach() ? sums.use.looks_without : sums.use.looks);
    sums.use.most_db = std::max(sums.use.most_db, part.most_db);
    if (part.out_of_reach()) {
      sums.beyond += following;
      sums.most_reach = std::max(sums.most_reach, part.reach > 0.0 ? part.reach : least_reach);
    } else if (part.ran.empty()) {
      sums.without += following;
    }
  }
}

// What was traced for a look.
void Account::add_tubes(std::size_t index, const TubeSums& tubes) {
  all_.tubes += tubes.tubes;
  all_.rays += tubes.rays;
  all_.lost_rays += tubes.lost_rays;
  if (tubes.lost_rays > 0) lost_rays_[index] = tubes.first_lost;
  add_look(all_.truncated, tubes.truncated);
  sliver_areas_[index] = tubes.sliver_area;
  if (all_.hits.size() < tubes.hits.size()) all_.hits.resize(tubes.hits.size());
  for (std::size_t b = 0; b < tubes.hits.size(); ++b) all_.hits[b] += tubes.hits[b];
  tube_counts_[0].count += tubes.empty_cells;
  tube_counts_[1].count += tubes.faces_away;
}

Statistics Account::finish() {
  tell_tubes();
  for (std::size_t i = 0; i < mechanisms_.size(); ++i) tell_mechanism(plan_.mechanisms[i], plan_.states[i], mechanisms_[i]);
  tell_lost_rays();
  all_.wedges = plan_.target.wedges.size();
  all_.paths = plan_.rays();
  all_.ray_range = plan_.ray_range;
  if (!plan_.fringe()) return std::move(all_);
  const auto [lowest, highest] = std::ranges::minmax(plan_.sweep.frequencies);
  all_.thin_plate_edges_lowest = count_thin(plan_.thin_plate_edges, lowest);
  all_.thin_plate_edges_highest = count_thin(plan_.thin_plate_edges, highest);
  return std::move(all_);
}

void Account::tell_tubes() {
  all_.sliver_area = std::accumulate(sliver_areas_.begin(), sliver_areas_.end(), 0.0);
  std::ranges::copy(plan_.skipped_wedges, std::back_inserter(all_.skipped));
  std::ranges::copy(plan_.skips, std::back_inserter(all_.skipped));
  if (plan_.tubes.skip && plan_.no_reflection() && !all_.hits.empty() && all_.hits[0] > 0)
    all_.skipped.push_back({"reflected tubes", nothing_in_front, all_.hits[0]});
  tell_counts(tube_counts_);
}

// What was done by its name, and what was left out by its reason.
void Account::tell_counts(const std::vector<Count>& counts) {
  for (const Count& count : counts) {
    if (count.why.empty())
      all_.counts.push_back(count);
    else if (count.count > 0)
      all_.skipped.push_back({count.what, count.why, count.count});
  }
}

// Whether a mechanism took part, and what is without it.
void Account::tell_mechanism(const MechanismEntry& mechanism, const MechanismState& state, const MechanismSums& sums) {
  all_.mechanisms.push_back(sums.use);
  const std::string looks = std::string("looks without ") + mechanism.label;
  const auto leave_out = [&](const std::string& why, std::uint64_t count, double figure = 0.0) {
    if (count > 0) all_.skipped.push_back({looks, why, count, figure});
  };
  if (state.missed) leave_out(state.why_not, plan_.sweep.looks.size());
  std::ranges::copy(state.skipped, std::back_inserter(all_.skipped));
  if (mechanism.budget_key) {  // with the share, if it was known in all of these looks before the mechanism began
    const bool known = sums.most_reach > 0.0 && sums.most_reach < least_reach;
    leave_out(std::string(mechanism.budget_key) + " reaches less than half of what is expected" +
                  (known ? " (about {:.2g} % at most)" : ""),
              sums.beyond, known ? 100.0 * sums.most_reach : 0.0);
  }
  if (mechanism.follows) return tell_counts(sums.counts);  // what it follows tells where both are left out
  if (sums.use.most_db == 0.0) {
    leave_out("there is nothing for it to work on", sums.without);
  } else if (!state.forced) {
    leave_out(
        fmt::format("too weak compared with the tubes for what they cost: expected to change a row by about {{:.2g}} dB at most, "
                    "accuracy.tolerance_db is {:g}",
                    plan_.tubes.tolerance_db),
        sums.without, sums.use.most_db);
  }
  tell_counts(sums.counts);
}

void Account::tell_lost_rays() {
  all_.looks_with_lost_rays = lost_rays_.size();
  for (const auto& [index, rays] : lost_rays_)
    for (const LostRay& ray : rays) {
      if (all_.first_lost_rays.size() == most_lost_rays_told) return;
      const std::size_t look = plan_.looks.computed[index];
      all_.first_lost_rays.push_back({ray.at + plan_.target.mesh.center, ray.triangle, look, plan_.sweep.looks[look].transmit});
    }
}

}  // namespace raytube
