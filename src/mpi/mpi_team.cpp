#include "mpi/mpi_team.h"

#include <mpi.h>

#include <algorithm>
#include <thread>

#include "core/bytes.h"
#include "mpi/mpi_calls.h"
#include "mpi/mpi_collectives.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

enum Tag : int { found_tag = 1, failed_tag = 2 };

constexpr std::size_t largest_chunk = 64, chunks_to_a_rank = 8;

int number_of(int (*what)(MPI_Comm, int*), int communicator) {
  const std::lock_guard lock(mpi_mutex);
  int number = 0;
  what(MPI_Comm_f2c(communicator), &number);
  return number;
}

}  // namespace

MpiTeam::MpiTeam(int communicator)
    : communicator_(communicator),
      rank_(number_of(MPI_Comm_rank, communicator)),
      ranks_(number_of(MPI_Comm_size, communicator)),
      counter_(communicator),
      outbox_(communicator) {}

void MpiTeam::begin(const std::vector<bool>& done, Take take) {
  std::string known(done.begin(), done.end());
  if (leads()) counter_.reset();
  mpi_broadcast(communicator_, known);
  items_ = done.size();
  todo_.clear();
  for (std::size_t item = 0; item < items_; ++item)
    if (known[item] == 0) todo_.push_back(item);
  chunk_begin_ = chunk_end_ = 0;
  missing_ = todo_.size();
  take_ = std::move(take);
  if (leads()) inbox_.emplace(communicator_, [this](int tag, const std::string& bytes) { take_message(tag, bytes); });
}

std::size_t MpiTeam::next() {
  const std::lock_guard lock(mutex_);
  require_all_well();
  if (chunk_begin_ == chunk_end_ && chunk_end_ < todo_.size()) {
    const std::size_t left = todo_.size() - chunk_end_, even = left / (chunks_to_a_rank * static_cast<std::size_t>(ranks_));
    const std::size_t size = std::clamp<std::size_t>(even, 1, largest_chunk);
    chunk_begin_ = std::min(counter_.add(size), todo_.size());
    chunk_end_ = std::min(chunk_begin_ + size, todo_.size());
    missing_ -= chunk_end_ - chunk_begin_;
  }
  return chunk_begin_ < chunk_end_ ? todo_[chunk_begin_++] : items_;
}

void MpiTeam::give(std::size_t item, std::string bytes) {
  ByteWriter writer(bytes.size() + 2 * sizeof item);
  writer(item), writer(bytes);
  outbox_.send(found_tag, writer.take());
}

void MpiTeam::finish() {
  outbox_.flush();
  const auto look_out = [this] {
    const std::lock_guard lock(mutex_);
    require_all_well();
  };
  while (leads() && !has_all()) {
    look_out();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  mpi_meet(communicator_, look_out);
  leave();
}

void MpiTeam::leave() noexcept {
  inbox_.reset();
  take_ = {};
}

void MpiTeam::tell_failure(int code, const std::string& sentence) {
  ByteWriter writer;
  writer(code), writer(sentence);
  outbox_.send(failed_tag, writer.take());
  outbox_.flush();
}

// What it throws is thrown where the leader looks for it.
void MpiTeam::take_message(int tag, const std::string& bytes) {
  try {
    if (tag == found_tag) return take_found(bytes);
    int code = 0;
    std::string sentence;
    ByteReader reader(bytes);
    reader(code), reader(sentence);
    throw RankFailed(code, sentence);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

void MpiTeam::take_found(const std::string& bytes) {
  std::size_t item = 0;
  std::string found;
  ByteReader reader(bytes);
  reader(item), reader(found);
  take_(item, std::move(found));
  const std::lock_guard lock(mutex_);
  --missing_;
}

void MpiTeam::require_all_well() {
  if (failure_) std::rethrow_exception(failure_);
}

bool MpiTeam::has_all() {
  const std::lock_guard lock(mutex_);
  return missing_ == 0;
}

}  // namespace raytube
