// What all ranks of a communicator, given by its Fortran handle, do together.
#pragma once

#include <functional>
#include <string>

namespace raytube {

/// Bytes of rank 0 to all others; they may be more than MPI counts in one go.
void mpi_broadcast(int communicator, std::string& bytes);

/// Returns when all have come here. `look_out` is called now and then meanwhile, and may throw.
void mpi_meet(int communicator, const std::function<void()>& look_out);

}  // namespace raytube
