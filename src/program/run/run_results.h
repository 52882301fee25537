// A run from the computation on, into its folder.
#pragma once

#include "program/products.h"
#include "program/run/prepared_run.h"
#include "program/run/result_names.h"
#include "program/run/stopwatch.h"
#include "scene/options.h"

namespace raytube {

/// The looks of merged shards, in the form that solve() takes.
struct MergedLooks {
  KeptLooks looks;
  std::size_t count;
};

/// A run that is ready for its computation.
struct RunTask {
  const RunOptions& asked;
  PreparedRun& prepared;
  const Destination& destination;
  const MergedLooks* merged;  // in place of a journal; null: there are none
  Product* product;           // null: there is none
  const Stopwatch& total;
};

/// Solves and writes everything. A run that does not come to its end leaves the finished looks for another one to resume. Throws
/// after its end if there are rows that must not be used.
void run_into_folder(const RunTask& task);

}  // namespace raytube
