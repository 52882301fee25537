// A case that is ready to be solved: read, with its target and its plan.
#pragma once

#include <memory>

#include "case/data/case.h"
#include "jobs/solve_case.h"
#include "mesh/load.h"
#include "output/files/journal.h"
#include "output/files/manifest.h"
#include "program/options.h"
#include "program/run/stopwatch.h"

namespace raytube {

struct PreparedRun {
  Case c;  // as it is solved
  MeshReport report;
  Manifest manifest;  // as far as it is known before the solve
  std::shared_ptr<const Target> target;
  std::vector<dvec3> outermost;  // points of the target as wide as all of it
  std::unique_ptr<const PlannedCase> planned;
};

/// `read`: the case as its file has it, for the manifest. Warns about the mesh and its materials. Throws InputError, also if the
/// memory does not suffice.
PreparedRun prepared_run(const RunOptions& asked, const Case& read, const Case& c, const Stopwatch& total);

/// The item of an identity that names the program.
inline constexpr const char* program_item = "version or build of raytube";

/// Everything that a finished look depends on. The number of threads changes no bit of it.
JournalIdentity identity_of(const Case& c, const Manifest& manifest);

}  // namespace raytube
