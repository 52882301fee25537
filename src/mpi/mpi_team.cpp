#include "mpi/mpi_team.h"

#include <mpi.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "core/bytes.h"
#include "mpi/mpi_calls.h"
#include "mpi/mpi_collectives.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

enum Tag : int { found_tag = 1, failed_tag = 2 };

constexpr std::size_t largest_chunk = 64, chunks_to_a_rank = 8;
constexpr std::size_t given_up = std::size_t{1} << 62;  // of the counter: beyond every list
constexpr auto between_questions = std::chrono::milliseconds(100);

int number_of(int (*what)(MPI_Comm, int*), int communicator) {
  const std::lock_guard lock(mpi_mutex);
  int number = 0;
  what(MPI_Comm_f2c(communicator), &number);
  return number;
}

RankFailed failure_of(const std::string& bytes) {
  int code = 0;
  std::string sentence;
  ByteReader reader(bytes);
  reader(code), reader(sentence);
  return {code, sentence};
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
  meet();
  if (leads()) counter_.reset();
  mpi_broadcast(communicator_, known);
  if (known.size() != done.size()) throw std::runtime_error("was given another number of looks than rank 0");
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
  while (leads() && !has_all()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  meet();
  inbox_.reset();
  take_ = {};
}

// Messages are received until all have met: those who send them wait for it.
void MpiTeam::leave() noexcept {
  if (leads()) counter_.add(given_up);
  const std::lock_guard lock(taking_);
  take_ = {};
}

bool MpiTeam::is_given_up() {
  const std::lock_guard lock(mutex_);
  if (leads()) return failure_ != nullptr;
  const auto now = std::chrono::steady_clock::now();
  if (now - asked_at_ < between_questions) return false;
  asked_at_ = now;
  return counter_.add(0) >= given_up;
}

void MpiTeam::meet() {
  if (has_failed_) return;
  const std::string told = mpi_first_of(communicator_, {}, [] {});
  if (told.empty()) return;
  has_failed_ = true;
  throw failure_of(told);
}

void MpiTeam::fail(int code, const std::string& sentence, const std::function<void()>& look_out) {
  if (std::exchange(has_failed_, true)) return;
  ByteWriter writer;
  writer(code), writer(sentence);
  std::string told = writer.take();
  if (!leads()) outbox_.send(failed_tag, told);
  outbox_.flush();
  {
    const std::lock_guard lock(mutex_);
    if (!heard_.empty()) told = heard_;
  }
  mpi_first_of(communicator_, std::move(told), look_out);
}

// What it throws is thrown where the leader looks for it.
void MpiTeam::take_message(int tag, const std::string& bytes) {
  try {
    if (tag == found_tag) return take_found(bytes);
    throw failure_of(bytes);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    if (tag == failed_tag && heard_.empty()) heard_ = bytes;
  }
}

void MpiTeam::take_found(const std::string& bytes) {
  std::size_t item = 0;
  std::string found;
  ByteReader reader(bytes);
  reader(item), reader(found);
  {
    const std::lock_guard lock(taking_);
    if (take_) take_(item, std::move(found));
  }
  const std::lock_guard lock(mutex_);
  --missing_;
}

void MpiTeam::require_all_well() {
  if (failure_) std::rethrow_exception(failure_);
}

bool MpiTeam::has_all() {
  const std::lock_guard lock(mutex_);
  require_all_well();
  return missing_ == 0;
}

}  // namespace raytube
