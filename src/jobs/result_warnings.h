// What is to be said of a result.
#pragma once

#include <string>
#include <vector>

#include "case/data/case.h"
#include "mesh/model/triangle_mesh.h"
#include "output/files/manifest.h"
#include "plan/target.h"
#include "scene/results.h"

namespace raytube {

/// `sentences`, which warnings_of (jobs/warnings) gave, then what is said of the mesh and of the rows that came out: all that a
/// result carries. No file is named in them.
std::vector<std::string> warnings_of_result(std::vector<std::string> sentences, const Case& c, const Target& target,
                                            const MeshReport& report, const Statistics& statistics);

/// What is known once a result is there, but for times.
void add_result(Manifest& manifest, const SweepResult& result, std::vector<std::string> warnings);

}  // namespace raytube
