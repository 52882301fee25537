// A run from the computation on, into its folder.
#pragma once

#include "program/products.h"
#include "program/run/prepared_run.h"
#include "program/run/result_names.h"
#include "program/run/stopwatch.h"
#include "scene/options.h"

namespace raytube {

/// Looks that shards have computed, as solve() takes them.
struct MergedLooks {
  KeptLooks looks;
  std::size_t count;
};

/// Solves and writes everything. If it does not come to its end it leaves the finished looks for another one to resume. Throws
/// after its end if there are rows that must not be used. `merged`: of shards, in place of a journal; null: there are none.
void run_into_folder(const Request& request, PreparedRun& prepared, const Destination& destination, const MergedLooks* merged,
                     const Stopwatch& total, Product* product = nullptr);

}  // namespace raytube
