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

/// SHA-256 of each mesh file, then of each file that these name.
std::vector<std::string> sha256_of_meshes(const Case& c, const MeshReport& report);

/// The case, the program and the files, meshes by their hashes: what of run.json is known before the solve.
Manifest described_inputs(const Case& c, const MeshReport& report, std::vector<std::string> mesh_sha256);

/// What is to be said of the mesh files as they were read: a warning each, coordinates too coarse
/// for the wavelength too.
std::vector<std::string> reading_sentences(const Case& c, const MeshReport& report);

}  // namespace raytube
