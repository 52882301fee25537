// Work that several processes share.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
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

}  // namespace raytube
