// The exit codes, and the exceptions that stand for them. Any other exception is a failure of the machine.
#pragma once

#include <stdexcept>

namespace raytube {

namespace exit_code {
inline constexpr int above_tolerance = 1;  // compare found more than the tolerance
inline constexpr int bad_input = 2;
inline constexpr int machine_failed = 3;  // disk, memory, a missing package
inline constexpr int unusable_rows = 4;   // the results are written, and some of their rows must not be used
}  // namespace exit_code

struct AboveTolerance : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct UnusableRows : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace raytube
