// How many threads a solve takes unless told otherwise.
#pragma once

#include <tbb/task_arena.h>

namespace raytube {

/// The processors this process may run on, which can be fewer than the machine has.
inline int all_threads() { return tbb::this_task_arena::max_concurrency(); }

}  // namespace raytube
