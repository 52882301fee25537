// Calls that the ranks of a communicator make together.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <memory>

#include "ranks/ranks.h"

namespace raytube::python {

using SharedRanks = std::shared_ptr<Ranks>;

/// Tells the other ranks what has befallen this one, and ends with them.
void give_up(Ranks& ranks, const std::exception_ptr& error);

/// The value of `work`, of which the ranks share some; then they share nothing any more. `ranks` null: of a process alone.
template <class Work>
auto shared_by(const SharedRanks& ranks, const Work& work) {
  if (!ranks) return work();
  try {
    auto value = work();
    ranks->end();
    return value;
  } catch (...) {
    give_up(*ranks, std::current_exception());
    throw;
  }
}

/// ranks_of: those of a communicator.
void bind_ranks(pybind11::module_& module);

}  // namespace raytube::python
