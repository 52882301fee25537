// A case made ready to be solved: read, with its target and its plan.
#pragma once

#include <memory>

#include "case/data/case.h"
#include "jobs/solve_case.h"
#include "mesh/load.h"
#include "output/files/journal.h"
#include "output/files/manifest.h"
#include "program/commands.h"
#include "program/run/stopwatch.h"

namespace raytube {

struct PreparedRun {
  Case c;  // as it is solved
  MeshReport report;
  Manifest manifest;  // as far as it is known before
  std::shared_ptr<const Target> target;
  std::vector<dvec3> outermost;  // points of the target as wide as all of it
  std::unique_ptr<const PlannedCase> planned;
};

/// `read`: the case as its file has it, which the manifest tells. Warns of what the mesh and its materials are. Throws
/// InputError, also if there is not the memory that it takes.
PreparedRun prepared_run(const Request& request, const Case& read, const Case& c, const Stopwatch& total);

/// The name of the item that says which program it is.
inline constexpr const char* program_item = "version or build of raytube";

/// What every bit of a finished look depends on, beside the number of threads, on which none does.
JournalIdentity identity_of(const Case& c, const Manifest& manifest);

}  // namespace raytube
