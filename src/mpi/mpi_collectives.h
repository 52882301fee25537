// What all ranks of a communicator, given by its Fortran handle, do together.
#pragma once

#include <functional>
#include <string>

namespace raytube {

/// Bytes of one rank to all others; they may be more than MPI counts in one go.
void mpi_broadcast(int communicator, std::string& bytes, int from = 0);

/// Returns when all have come here: of the first rank that brings any bytes these; none if none does. `look_out` is called now
/// and then meanwhile, and may throw.
std::string mpi_first_of(int communicator, std::string bytes, const std::function<void()>& look_out);

}  // namespace raytube
