#include "mpi/mpi_collectives.h"

#include <mpi.h>

#include <algorithm>
#include <cstdint>

#include "mpi/mpi_calls.h"

namespace raytube {

namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 30;  // [bytes] counts are of 31 bits

bool is_over(MPI_Request& request) {
  int over = 0;
  MPI_Test(&request, &over, MPI_STATUS_IGNORE);
  return over != 0;
}

void broadcast(MPI_Comm all, void* data, std::size_t size, int from) {
  MPI_Request request = MPI_REQUEST_NULL;
  {
    const std::lock_guard lock(mpi_mutex);
    MPI_Ibcast(data, static_cast<int>(size), MPI_BYTE, from, all, &request);
  }
  wait_until([&] { return is_over(request); });
}

}  // namespace

void mpi_broadcast(int communicator, std::string& bytes, int from) {
  MPI_Comm all = MPI_Comm_f2c(communicator);
  std::uint64_t size = bytes.size();
  broadcast(all, &size, sizeof size, from);
  bytes.resize(size);
  for (std::size_t at = 0; at < size; at += most_at_once)
    broadcast(all, bytes.data() + at, std::min<std::size_t>(most_at_once, size - at), from);
}

std::string mpi_first_of(int communicator, std::string bytes, const std::function<void()>& look_out) {
  MPI_Comm all = MPI_Comm_f2c(communicator);
  MPI_Request request = MPI_REQUEST_NULL;
  int rank = 0, first = 0, none = 0;
  {
    const std::lock_guard lock(mpi_mutex);
    MPI_Comm_rank(all, &rank);
    MPI_Comm_size(all, &none);
    if (bytes.empty()) rank = none;
    MPI_Iallreduce(&rank, &first, 1, MPI_INT, MPI_MIN, all, &request);
  }
  wait_until([&] { return is_over(request); }, look_out);
  if (first == none) return {};
  mpi_broadcast(communicator, bytes, first);
  return bytes;
}

}  // namespace raytube
