// Several processes at one command: one process leads and does the command, the others compute for it.
#pragma once

#include <functional>

#include "case/data/case.h"
#include "core/work_team.h"
#include "output/files/journal.h"
#include "plan/target.h"
#include "program/options.h"

namespace raytube {

/// The team of the job; null for a process alone.
WorkTeam* team_of(const Work& work);

/// Gives the other processes the mesh, which the leader alone has read and repaired, and what they must have been asked for:
/// `asked` beside the case. Does nothing for a process alone.
void share_work(const Work& work, const JournalIdentity& asked, const Case& c, const TriangleMesh& mesh);

/// The other side of share_work(): takes the mesh, reads the case and calls `compute`. Throws InputError for other work than the
/// leader's.
void help_leader(const Work& work, const CaseInput& input, const JournalIdentity& asked,
                 const std::function<void(const Case&, const Target&)>& compute);

void help_to_run(const RunOptions& run);

}  // namespace raytube
