// Looks shared by the ranks of a communicator.
//
//     the next item   a counter at rank 0, which every rank adds to by one-sided calls: several items at a time while there are
//                     many left, one by one in the end (guided self-scheduling: Polychronopoulos & Kuck, IEEE Trans. Computers
//                     C-36 (1987), 1425)
//     what was found  messages to rank 0, where a thread takes them as they come
//     who has failed  tells rank 0, which moves the counter to its end. All meet where lists begin and end, and at the very end,
//                     and hear of it there: a rank that fails calls what the others call
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "core/work_team.h"
#include "mpi/mpi_counter.h"
#include "mpi/mpi_messages.h"

namespace raytube {

class MpiTeam final : public WorkTeam {
 public:
  /// The Fortran handle of a communicator that nobody else sends messages on; it must outlive this. To be called by all its
  /// ranks.
  explicit MpiTeam(int communicator);

  bool leads() const override { return rank_ == 0; }
  void begin(const std::vector<bool>& done, Take take) override;
  std::size_t next() override;
  void give(std::size_t item, std::string bytes) override;
  void finish() override;
  void leave() noexcept override;
  bool is_given_up() override;

  /// In the end, of all ranks together: what they share beyond their own memory.
  void free() { counter_.free(); }

  /// Returns when all have come here. Throws what has befallen any of them as RankFailed, once.
  void meet();

  /// In place of the next meeting of the others: tells them what has befallen this one, as rank 0 at once. What it has heard from
  /// another one it passes on. `look_out` is called now and then until all have come, and may throw.
  void fail(int code, const std::string& sentence, const std::function<void()>& look_out);

 private:
  void take_message(int tag, const std::string& bytes);
  void take_found(const std::string& bytes);
  void require_all_well();
  bool has_all();

  int communicator_, rank_, ranks_;
  MpiCounter counter_;
  MpiOutbox outbox_;
  std::vector<std::size_t> todo_{};
  std::size_t items_ = 0;
  Take take_{};                                  // empty: what comes is of no use any more
  std::mutex taking_{};                          // of the one above
  std::size_t chunk_begin_ = 0, chunk_end_ = 0;  // of todo_, for this rank
  std::size_t missing_ = 0;                      // of todo_: of other ranks, not here yet
  std::exception_ptr failure_{};
  std::string heard_{};                               // from one that has failed
  std::chrono::steady_clock::time_point asked_at_{};  // whether the leader has given up
  std::mutex mutex_{};                                // of the six above
  bool has_failed_ = false;                           // one of them, as all know
  std::optional<MpiInbox> inbox_{};
};

}  // namespace raytube
