// What a run is made from, for the record.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/data/case.h"
#include "mesh/model/triangle_mesh.h"
#include "output/files/manifest.h"

namespace raytube {

/// The counts of a mesh report by the names they have in files.
std::vector<std::pair<std::string, double>> mesh_counts(const MeshReport& report);

/// The case, the program and the files: what of run.json is known before the solve.
Manifest described_inputs(const Case& c, const MeshReport& report);

}  // namespace raytube
