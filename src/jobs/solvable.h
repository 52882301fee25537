// Whether a case can be solved once its mesh is read, and how: the same answer for whoever asks.
#pragma once

#include "case/data/case.h"
#include "core/error.h"
#include "plan/plan.h"

namespace raytube {

/// Throws InputError for a case in which bodies move.
void refuse_motion(const Case& c);

/// Throws InputError, which begins with `place`, unless the case has that look.
void require_look(const Case& c, std::size_t look, const std::string& place = "look");

/// The plan of a case that stands. Throws InputError, with the case file, for whatever a run of it would be refused for, images
/// included, but for want of memory. Refers to `target` and to the case.
SolvePlan plan_of_case(const Target& target, const Case& c, int threads, bool keep_parts);

/// The case with this look alone, at one of its frequencies.
Case case_of_look(const Case& c, std::size_t look, std::size_t frequency_index);

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
