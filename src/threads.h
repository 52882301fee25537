// How many threads work takes.
#pragma once

#include <functional>

namespace raytube {

/// The processors this process may run on, which can be fewer than the machine has.
int all_threads();

/// Lets this many threads do the work, 0: all_threads(). More than there are processors must be asked for; a host program's own
/// limit is never lowered.
void run_on_threads(int threads, const std::function<void()>& work);

}  // namespace raytube
