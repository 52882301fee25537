// A case made ready to be solved: read, with its target and its plan.
#pragma once

#include <memory>

#include "case/data/case.h"
#include "mesh/load.h"
#include "output/files/journal.h"
#include "output/files/manifest.h"
#include "plan/plan.h"
#include "program/commands.h"
#include "program/run/stopwatch.h"

namespace raytube {

struct PreparedRun {
  Case c;  // as it is solved
  MeshReport report;
  Manifest manifest;  // as far as it is known before
  std::unique_ptr<const Target> target;
  std::unique_ptr<const SolvePlan> plan;
};

/// `read`: the case as its file has it, which the manifest tells. Warns of what the mesh and its materials are. Throws
/// InputError, also if there is not the memory that it takes.
PreparedRun prepared_run(const Request& request, const Case& read, const Case& c, const Stopwatch& total);

/// What every bit of a finished look depends on, beside the number of threads, on which none does.
JournalIdentity identity_of(const Case& c, const Manifest& manifest);

}  // namespace raytube
