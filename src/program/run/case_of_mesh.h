// A mesh in place of a case: the few settings of the command line make a case of it.
#pragma once

#include <string>

#include "program/options.h"

namespace raytube {

/// Numbers as "10", "9,10,11" or "0:360:1".
struct MeshOptions {
  std::string unit, ghz, azimuth, elevation;
};

void add_mesh_options(CLI::App& run, MeshOptions& mesh);

/// Where the run is given a mesh: writes the case that the options make as case.toml into the folder of the results (for
/// -o FILE.nc as FILE.toml beside it), over an earlier one by raytube, and makes it the input of the run. Throws InputError for
/// missing options, and where a case is given together with options of a mesh.
void make_case_of_mesh(const MeshOptions& mesh, RunOptions& run);

}  // namespace raytube
