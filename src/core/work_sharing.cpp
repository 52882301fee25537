#include "core/work_sharing.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "core/threads.h"

namespace raytube {

void compute_items(WorkTeam& team, std::size_t items, int threads, const std::function<void(std::size_t)>& compute) {
  const auto compute_next_ones = [&](const tbb::blocked_range<int>&) {
    for (std::size_t item = team.next(); item < items && !tbb::is_current_task_group_canceling(); item = team.next())
      tbb::this_task_arena::isolate([&] { compute(item); });
  };
  const int workers = threads > 0 ? threads : all_threads();
  tbb::parallel_for(tbb::blocked_range<int>(0, workers), compute_next_ones, tbb::simple_partitioner());
}

}  // namespace raytube
