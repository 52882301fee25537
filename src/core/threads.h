// How many threads work takes.
#pragma once

#include <functional>

namespace raytube {

/// The processors this process may run on, which can be fewer than the machine has.
int all_threads();

/// Lets this many threads do the work, 0: all_threads(). More than there are processors must be asked for; a host program's own
/// limit is never lowered.
void run_on_threads(int threads, const std::function<void()>& work);

/// To be called after a parallel loop that may lie inside another one: when an exception stops the outer one, the inner one
/// returns as if it were done. Throws Interrupted then.
void stop_if_cancelled();

}  // namespace raytube
