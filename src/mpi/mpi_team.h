// Looks shared by the ranks of a communicator.
//
//     the next item   a counter at rank 0, which every rank adds to by one-sided calls: several items at a time while there are
//                     many left, one by one in the end (guided self-scheduling: Polychronopoulos & Kuck, IEEE Trans. Computers
//                     C-36 (1987), 1425)
//     what was found  messages to rank 0, where a thread takes them as they come
#pragma once

#include <exception>
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

  /// Tells rank 0 what has befallen this one; there next() and finish() throw it as RankFailed.
  void tell_failure(int code, const std::string& sentence);

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
  Take take_{};
  std::size_t chunk_begin_ = 0, chunk_end_ = 0;  // of todo_, for this rank
  std::size_t missing_ = 0;                      // of todo_: of other ranks, not here yet
  std::exception_ptr failure_{};
  std::mutex mutex_{};  // of the four above
  std::optional<MpiInbox> inbox_{};
};

}  // namespace raytube
