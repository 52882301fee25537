// Whether a case can be solved once its mesh is read: the same answer for whoever asks.
#pragma once

#include "case/case.h"
#include "core/error.h"
#include "solve/solve.h"

namespace raytube {

/// Throws InputError, with the case file, for whatever a run of the case would be refused for, but for want of memory.
void check_solvable(const Target& target, const Case& c);

/// Does what it is told; what the solver says knows no files, so an InputError gets the case file.
template <class Action>
auto naming_the_case(const Case& c, const Action& action) {
  try {
    return action();
  } catch (const InputError& error) {
    throw InputError(c.file.string() + ": " + error.what());
  }
}

}  // namespace raytube
