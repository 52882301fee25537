// Several processes at one command: the one that leads does it, and the others help.
#pragma once

#include "case/data/case.h"
#include "core/work_team.h"
#include "plan/target.h"
#include "program/commands.h"

namespace raytube {

/// Of the job; null for a process alone.
WorkTeam* team_of(const Request& request);

/// The target's mesh, as it was read and mended once, to those that help, and what they must have been asked for, too.
void share_work(const Request& request, const Case& c, const TriangleMesh& mesh);

/// What converge is helped with.
void help_to_converge(const Request& request, const Case& c, const Target& target);

}  // namespace raytube
