// Work that several processes share.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace raytube {

/// Items of work, each computed by whoever takes it first. One process, the leader, collects what all find. begin() and finish()
/// are called once by every process for each list of items, from one thread; the others from any.
class WorkTeam {
 public:
  /// Takes what another process has found for an item, as bytes; one at a time.
  using Take = std::function<void(std::size_t item, std::string bytes)>;

  WorkTeam() = default;
  virtual ~WorkTeam() = default;
  WorkTeam(const WorkTeam&) = delete;
  WorkTeam& operator=(const WorkTeam&) = delete;

  /// True for the process that collects.
  virtual bool leads() const = 0;

  /// Items that are `done`, in the leader's list, are computed by nobody; the lists of others have its length alone. `take`: of
  /// the leader.
  virtual void begin(const std::vector<bool>& done, Take take) = 0;

  /// The item to compute next; the length of the list: none is left.
  virtual std::size_t next() = 0;

  /// Sends what was found to the leader: of the others.
  virtual void give(std::size_t item, std::string bytes) = 0;

  /// Returns when everything is where it belongs. Throws what has befallen any process meanwhile.
  virtual void finish() = 0;

  /// In place of finish(), of whoever gives up: from then on nothing is taken.
  virtual void leave() noexcept = 0;

  /// Whether one has left it, so that what the others compute is of no use any more. finish() throws why.
  virtual bool is_given_up() = 0;
};

/// Between begin() and finish() of one process: leaves the team if it does not come to the latter.
class TeamMember {
 public:
  /// WorkTeam::begin.
  TeamMember(WorkTeam& team, const std::vector<bool>& done, WorkTeam::Take take) : team_(team) {
    team_.begin(done, std::move(take));
  }
  ~TeamMember() {
    if (!finished_) team_.leave();
  }
  TeamMember(const TeamMember&) = delete;
  TeamMember& operator=(const TeamMember&) = delete;

  /// WorkTeam::finish.
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
  /// Always.
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
