// Bad input and interruption: the two things that solver and program throw.
#pragma once

#include <stdexcept>
#include <string>

namespace raytube {

/// Bad input from the user: one sentence with the place (file, key or line) and the remedy. The program exits with code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The computation was stopped from outside (Ctrl-C) before it was complete.
struct Interrupted : std::runtime_error {
  /// With the sentence for the user.
  explicit Interrupted(const std::string& sentence = "interrupted; no results written") : std::runtime_error(sentence) {}
};

}  // namespace raytube
