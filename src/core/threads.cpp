#include "core/threads.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstddef>

#include "core/error.h"

namespace raytube {

int all_threads() { return tbb::this_task_arena::max_concurrency(); }

void run_on_threads(int threads, const std::function<void()>& work) {
  const int count = threads > 0 ? threads : all_threads();
  constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;
  const tbb::global_control limit(parallelism, std::max<std::size_t>(count, tbb::global_control::active_value(parallelism)));
  tbb::task_arena(count).execute(work);
}

void stop_if_cancelled() {
  if (tbb::is_current_task_group_canceling()) throw Interrupted();
}

}  // namespace raytube
