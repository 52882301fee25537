// How much memory a solve will take, before it begins.
#pragma once

#include <vector>

#include "plan/plan.h"

namespace raytube {

/// What the bytes of a part grow with. How dense the tubes are plays no part: tiles are streamed.
enum class MemoryOf {
  rows,    // of the sweep
  image,   // its cells
  looks,   // under way: one for each thread
  program  // and the target, whatever is asked of them
};

/// One thing that a run holds.
struct MemoryPart {
  const char* what;
  MemoryOf of;
  double bytes;
};

/// What a solve takes: upper bounds but for what threads and libraries take for themselves, as a target may have fewer bounces
/// than `max_bounces`.
std::vector<MemoryPart> estimate_memory(const SolvePlan& plan);

/// The bytes of all parts that grow with the same.
double bytes_of(const std::vector<MemoryPart>& parts, MemoryOf of);

}  // namespace raytube
