// How one process takes part in work that several share.
#pragma once

#include <atomic>
#include <utility>

#include "core/work_team.h"

namespace raytube {

/// Between begin() and finish() of one process: leaves the team if it does not come to the latter.
class TeamMember {
 public:
  TeamMember(WorkTeam& team, const std::vector<bool>& done, WorkTeam::Take take) : team_(team) {
    team_.begin(done, std::move(take));
  }
  ~TeamMember() {
    if (!finished_) team_.leave();
  }
  TeamMember(const TeamMember&) = delete;
  TeamMember& operator=(const TeamMember&) = delete;

  void finish() {
    team_.finish();
    finished_ = true;
  }

 private:
  WorkTeam& team_;
  bool finished_ = false;
};

/// A process alone.
class TeamOfOne final : public WorkTeam {
 public:
  bool leads() const override { return true; }
  void begin(const std::vector<bool>& done, Take /*take*/) override { done_ = done, next_ = 0; }
  std::size_t next() override {
    std::size_t item = next_++;
    while (item < done_.size() && done_[item]) item = next_++;
    return item < done_.size() ? item : done_.size();
  }
  void give(std::size_t /*item*/, std::string /*bytes*/) override {}
  void finish() override {}
  void leave() noexcept override {}
  bool is_given_up() override { return false; }

 private:
  std::vector<bool> done_;
  std::atomic<std::size_t> next_ = 0;
};

/// Computes the items that the team leaves to this process, on so many threads. One that waits for others within its item begins
/// no other: so many items are under way as there are threads.
void compute_items(WorkTeam& team, std::size_t items, int threads, const std::function<void(std::size_t)>& compute);

}  // namespace raytube
