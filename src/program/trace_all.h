// raytube trace --all: the ways that the tubes of a look take, and the facets that they meet.
#pragma once

#include "case/data/case.h"
#include "mesh/model/triangle_mesh.h"
#include "program/commands.h"
#include "scene/tube_paths.h"

namespace raytube {

/// Throws InputError if the files asked for cannot be written.
void check_trace_files(const Request& request);

/// Those of the look asked for, at the frequency of this number among those of the case.
TubePaths all_tubes(const Request& request, const Case& c, const TriangleMesh& mesh, std::size_t frequency);

/// Prints how many go where, and writes the files asked for.
void tell_tubes(const Request& request, const TriangleMesh& mesh, const TubePaths& tubes);

}  // namespace raytube
