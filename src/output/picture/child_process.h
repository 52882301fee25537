// Other programs that raytube runs: gnuplot and Python.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace raytube {

enum class ChildOutput { silent, ours };

struct ChildEnd {
  bool missing = false;  // there is no such program
  int code = 0;          // exit code; -1 if a signal ended it
};

/// Runs a program of the search path and waits for its end. No shell stands in between, so nothing in an argument needs quoting.
/// An interrupt that reaches raytube is passed on. `environment` is added to ours.
ChildEnd run_child(const std::vector<std::string>& arguments, ChildOutput output,
                   const std::vector<std::pair<std::string, std::string>>& environment = {});

}  // namespace raytube
