#include "mpi/mpi_counter.h"

#include <mpi.h>

#include <cstdint>

#include "mpi/mpi_calls.h"

namespace raytube {

struct MpiCounter::Window {
  MPI_Win window = MPI_WIN_NULL;
  std::int64_t* number = nullptr;  // at rank 0
};

MpiCounter::MpiCounter(int communicator) : window_(new Window) {
  const std::lock_guard lock(mpi_mutex);
  MPI_Comm all = MPI_Comm_f2c(communicator);
  int rank = 0;
  MPI_Comm_rank(all, &rank);
  const MPI_Aint size = rank == 0 ? sizeof(std::int64_t) : 0;
  MPI_Win_allocate(size, sizeof(std::int64_t), MPI_INFO_NULL, all, &window_->number, &window_->window);
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window_->window);
}

MpiCounter::~MpiCounter() = default;

void MpiCounter::free() {
  const std::lock_guard lock(mpi_mutex);
  MPI_Win_unlock_all(window_->window);
  MPI_Win_free(&window_->window);
}

void MpiCounter::reset() {
  const std::lock_guard lock(mpi_mutex);
  constexpr std::int64_t zero = 0;
  MPI_Accumulate(&zero, 1, MPI_INT64_T, 0, 0, 1, MPI_INT64_T, MPI_REPLACE, window_->window);
  MPI_Win_flush(0, window_->window);
}

std::size_t MpiCounter::add(std::size_t count) {
  const std::lock_guard lock(mpi_mutex);
  const auto added = static_cast<std::int64_t>(count);
  std::int64_t before = 0;
  MPI_Fetch_and_op(&added, &before, MPI_INT64_T, 0, 0, MPI_SUM, window_->window);
  MPI_Win_flush(0, window_->window);
  return static_cast<std::size_t>(before);
}

}  // namespace raytube
